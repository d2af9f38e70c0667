// The view as a whole: one state, one cursor, and the controls that change them.

function makeState(page) {
  return {
    page,
    frame: page.frames[0],
    camera: makeCamera(),
    chosen: null,
    shown: 0,
    belowDb: -30,
    cursor: null,
    isHeld: false,
    layers: {},
    colours: readColours(),
    picture: null,
    moving: makeMotion(),
  };
}

function startViewer() {
  const page = readPage();
  document.getElementById("viewer").hidden = false;
  const state = makeState(page);
  const space = makeSpace(part("space"), page, state);
  if (!space)
    part("space-place").replaceChildren(
      "This browser has no WebGL 2; the map below still works, and the drawings show the scene.",
    );
  const view = { page, state, space, isWaiting: false, names: [] };
  part("frame").max = page.frames.length - 1;
  part("frame-label").hidden = page.frames.length < 2;
  part("level-label").hidden = !page.frames.some(({ shown }) => shown.paths);
  hearControls(view);
  if (space) hearSpace(view);
  hearMap(view);
  chooseFrame(view, 0);
  stand(view, "around");
  globalThis.waysideViewer = handle(view);
}

/** What other programs of the page drive the view by. */
function handle(view) {
  const { state, space } = view;
  const middleOf = ({ place_m, mesh }) =>
    add(place_m, [0, 0, mesh === null ? 0 : view.page.surroundings.meshes[mesh].box_m[1][2] / 2]);
  return {
    view,
    draw: () => drawAll(view),
    choose: (index) => choose(view, index),
    pixelOf: (index) => onScreen(space, middleOf(state.frame.bodies[index])),
    pixelOfPlace: (place) => onScreen(space, place),
    pixelOnMap: (range, velocity) =>
      pixelOnMap(part("map"), state.frame.map, snapped(state.frame.map, { range, velocity })),
  };
}

function chooseFrame(view, number) {
  const { page, state, space } = view;
  const chosen = state.chosen === null ? null : state.frame.bodies[state.chosen].id;
  const told = page.frames[number];
  state.frame = {
    ...told.shown,
    targets: told.targets,
    error_db: told.error_db,
    model_error_db: told.model_error_db,
  };
  const again = state.frame.bodies.findIndex(({ id }) => id === chosen);
  state.chosen = again < 0 ? null : again;
  state.picture = mapPicture(state.frame.map);
  const cursor = state.cursor ?? { ...strongestCell(state.frame.map), source: "start" };
  state.cursor = { ...cursor, found: null };
  if (space) showFrame(space, state.frame);
  part("frame-told").textContent = ` ${state.frame.index} at ${told.shown.time_s.toFixed(3)} s`;
  tellOfRun(view);
  makeNames(view);
  chooseLevel(view);
}

function chooseLevel(view) {
  const { state } = view;
  const { paths } = state.frame;
  state.belowDb = part("level").valueAsNumber;
  state.shown = paths ? countDownTo(paths, state.belowDb) : 0;
  const told = paths ? toldOfPaths(paths, state.shown) : "no paths: echoes of tables";
  part("level-told").textContent =
    ` ${String(state.belowDb).replace("-", "−")} dB of the strongest: ${told}`;
  tellOfOrders(view);
  choose(view, state.chosen);
}

function choose(view, index) {
  view.state.chosen = index;
  fillPanel(part("panel"), view.state, () => choose(view, null));
  redraw(view);
}

function stand(view, place) {
  const { page, state } = view;
  const { radar, meshes } = page.surroundings;
  const bodies = state.frame.bodies.flatMap((body) => cornersOf(body, meshes));
  const near = [...bodies, ...state.frame.objects.map(({ place_m }) => place_m)];
  const within = near.filter(
    (p) => Math.hypot(...subtract(p, radar.position_m)) <= 1.2 * radar.range_max_m,
  );
  const places = [radar.position_m, [...radar.position_m.slice(0, 2), 0], ...within];
  const { clientWidth, clientHeight } = part("space-place");
  standAt(state.camera, place, radar, places, clientWidth / Math.max(1, clientHeight));
  redraw(view);
}

/** Draws while the eye moves; all paths again when it rests. */
function move(view) {
  const { moving } = view.state;
  beginMotion(moving);
  clearTimeout(moving.rest);
  moving.rest = setTimeout(() => {
    endMotion(moving);
    redraw(view);
  }, REST_MS);
  redraw(view);
}

function redraw(view) {
  atNextPicture(view, () => {
    drawAll(view);
    if (!view.state.moving.isOn) drawMaps(view);
  });
}

function drawAll({ space, names, state }) {
  if (!space) return;
  drawSpace(space);
  placeNames({ names, space, state });
}

function drawMaps({ state }) {
  drawMap(part("map"), state);
  part("scale-told").textContent = toldOfScale(state.frame.map);
  drawRangeProfile(part("range"), state);
  drawDopplerCut(part("doppler"), state);
  part("readout").textContent = readout(state);
}

startViewer();
