// What pointer, keys and controls do.

function hearControls(view) {
  part("frame").addEventListener("input", () => chooseFrame(view, part("frame").valueAsNumber));
  part("level").addEventListener("input", () => chooseLevel(view));
  hearSurroundings(view, (place) => stand(view, place));
}

/** What every view hears: layers, places to stand, light or dark, its size. */
function hearSurroundings(view, standAtPlace) {
  const { state } = view;
  for (const box of document.querySelectorAll("#viewer [data-layer]")) {
    state.layers[box.dataset.layer] = box.checked;
    box.addEventListener("change", () => {
      state.layers[box.dataset.layer] = box.checked;
      redraw(view);
    });
  }
  for (const button of document.querySelectorAll("#viewer [data-place]")) {
    button.addEventListener("click", () => standAtPlace(button.dataset.place));
  }
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    state.colours = readColours();
    redraw(view);
  });
  new ResizeObserver(() => redraw(view)).observe(document.getElementById("viewer"));
}

/** Draws at the screen's next picture, however often it is asked. */
function atNextPicture(view, draw) {
  if (view.isWaiting) return;
  view.isWaiting = true;
  requestAnimationFrame(() => {
    view.isWaiting = false;
    draw();
  });
}

/** The map sets the cursor, the range profile its range alone, the Doppler cut its velocity alone. */
function hearMap(view) {
  const { state } = view;
  hearCursor(view, part("map"), (cell) => cell);
  hearCursor(view, part("range"), ({ range }) => ({ range, velocity: state.cursor.velocity }));
  hearCursor(view, part("doppler"), ({ velocity }) => ({ range: state.cursor.range, velocity }));
  part("map").addEventListener("keydown", (event) => stepCursor(view, event));
}

/** The cursor follows the pointer over a canvas, and is held by a click; `taken`: what is taken of a cell. */
function hearCursor(view, canvas, taken) {
  const { state } = view;
  const at = (event) => {
    const cell = cellUnder(canvas, state.frame.map, [event.offsetX, event.offsetY]);
    return cell && taken(cell);
  };
  canvas.addEventListener("pointermove", (event) => {
    const cell = at(event);
    if (!state.isHeld && cell) pointAt(view, { ...cell, source: "map" });
  });
  canvas.addEventListener(
    "pointerleave",
    () => !state.isHeld && pointAt(view, { ...state.cursor, source: "left" }),
  );
  canvas.addEventListener("click", (event) => {
    const cell = at(event);
    state.isHeld = cell !== null && !state.isHeld;
    if (cell) pointAt(view, { ...cell, source: "map" });
  });
}

/** Arrow keys move the cursor from cell to cell. */
function stepCursor(view, event) {
  const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[
    event.key
  ];
  if (!steps) return;
  event.preventDefault();
  const { map } = view.state.frame;
  const from = view.state.cursor ?? { range: (map.range_m[1] * map.columns) / 2, velocity: 0 };
  const cell = {
    range: from.range + steps[0] * map.range_m[1],
    velocity: from.velocity + steps[1] * map.velocity_mps[1],
  };
  view.state.isHeld = true;
  pointAt(view, { ...snapped(map, cell), source: "map" });
}

function pointAt(view, cursor) {
  view.state.cursor = cursor;
  redraw(view);
}

function hearSpace(view) {
  const { canvas } = view.space;
  const pointers = new Map();
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY, moved: 0 });
  });
  canvas.addEventListener("pointermove", (event) => {
    if (pointers.has(event.pointerId)) drag(view, pointers, event);
    else hoverSpace(view, event);
  });
  canvas.addEventListener("pointerup", (event) => {
    const pointer = pointers.get(event.pointerId);
    pointers.delete(event.pointerId);
    if (!pointer || pointer.moved >= 5) return;
    hoverSpace(view, event); // a finger does not hover before it touches
    choose(view, thingUnder(view.space, [event.offsetX, event.offsetY]));
  });
  canvas.addEventListener("pointercancel", (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => comeNearer(view, event), { passive: false });
  canvas.addEventListener("keydown", (event) => stepEye(view, event));
}

/** One pointer turns, or moves with Shift or the right button; two move and come nearer. */
function drag(view, pointers, event) {
  const { camera } = view.state;
  const pointer = pointers.get(event.pointerId);
  const [dx, dy] = [event.offsetX - pointer.x, event.offsetY - pointer.y];
  const apart = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  const before = pointers.size === 2 ? apart() : 0;
  Object.assign(pointer, {
    x: event.offsetX,
    y: event.offsetY,
    moved: pointer.moved + Math.hypot(dx, dy),
  });
  const share = 1 / view.space.canvas.clientHeight;
  if (pointers.size === 2) {
    approach(camera, before / Math.max(1, apart()));
    walk(camera, (-dx * share) / 2, (dy * share) / 2);
  } else if (event.shiftKey || event.buttons === 2) {
    walk(camera, -dx * share, dy * share);
  } else {
    turn(camera, 3 * dx * share, 3 * dy * share);
  }
  move(view);
}

function comeNearer(view, event) {
  if (document.activeElement !== view.space.canvas && !event.ctrlKey) return;
  event.preventDefault();
  approach(view.state.camera, Math.exp(0.001 * event.deltaY));
  move(view);
}

function hoverSpace(view, event) {
  const { state, space } = view;
  if (state.isHeld) return;
  const found = foundUnder(space, [event.offsetX, event.offsetY]);
  if (!found) return;
  pointAt(view, { range: found.range, velocity: found.velocity, source: "space", found });
}

function stepEye(view, event) {
  const { camera } = view.state;
  const steps = {
    ArrowLeft: () => turn(camera, -0.1, 0),
    ArrowRight: () => turn(camera, 0.1, 0),
    ArrowUp: () => turn(camera, 0, 0.05),
    ArrowDown: () => turn(camera, 0, -0.05),
    w: () => walk(camera, 0, 0.05),
    s: () => walk(camera, 0, -0.05),
    a: () => walk(camera, -0.05, 0),
    d: () => walk(camera, 0.05, 0),
    "+": () => approach(camera, 0.9),
    "-": () => approach(camera, 1.1),
  };
  const step = steps[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  step();
  move(view);
}
