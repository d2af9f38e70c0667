// The view in three dimensions: what is on the card, how it is drawn, and what lies under the pointer.

/** Half a cell and a bit, so that the cell of the cursor and its neighbours are bright. */
const CURSOR_CELLS = 1.5;

function makeSpace(canvas, page, state) {
  const graphics = makeGraphics(canvas);
  if (!graphics) return null;
  const { radar, roads_m, lines_m, meshes } = page.surroundings;
  const surface = ({ corners, triangles }) => surfaceBuffer(graphics, corners, triangles);
  const lanes = lines_m.flatMap((line) => {
    const out = [];
    addLines(
      out,
      line.map(([x, y]) => [x, y, LINE_HEIGHT_M]),
      { colour: MARK.lanes },
    );
    return out;
  });
  return {
    canvas,
    graphics,
    page,
    state,
    radar,
    road: surface(roadSurface(roads_m)),
    beam: surface(beamSurface(radar)),
    lanes: markBuffer(graphics, lanes),
    radarLines: markBuffer(graphics, radarLines(radar)),
    radarDot: markBuffer(graphics, radarDot(radar)),
    meshes: meshes.map((mesh) => surface(meshSurface(mesh))),
    frame: null,
  };
}

function meshSurface({ corners_m, triangles, box_m }) {
  return corners_m
    ? { corners: corners_m, triangles }
    : { corners: boxCorners(box_m).flat(), triangles: FACES };
}

/** Puts the marks of a frame on the card, in the place of those before. */
function showFrame(space, frame) {
  const { graphics } = space;
  if (space.frame)
    Object.values(space.frame).forEach((buffer) => buffer.array && forget(graphics, buffer));
  const none = { lines: makeMarks(), dots: makeMarks() };
  const { lines, dots } = frame.paths ? wayMarks(frame.paths, space.radar) : none;
  space.ends = [lines.ends, dots.ends];
  space.frame = {
    pathLines: markBuffer(graphics, lines.numbers),
    pathDots: markBuffer(graphics, dots.numbers),
    boxes: markBuffer(graphics, boxLines(frame, space.page.surroundings.meshes)),
    points: markBuffer(graphics, pointDots(frame)),
    objects: markBuffer(graphics, objectRings(frame)),
    tracks: markBuffer(graphics, trackLines(frame)),
  };
}

function drawSpace(space) {
  const {
    canvas,
    graphics: { gl },
    state,
  } = space;
  const pixels = resize(canvas);
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clearColor(...rgba(state.colours.paper).slice(0, 3), 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  const clip = clipFromWorld(state.camera, canvas.width / canvas.height);
  drawGround(space, clip, pixels);
  gl.enable(gl.DEPTH_TEST);
  if (state.layers.bodies) drawBodies(space, clip);
  drawFrameMarks(space, { clip, pixels, colours: state.colours.marks });
  drawCursor(space, { clip, pixels, colours: state.colours.marks });
}

/** The ground is flat and lies below everything: it needs no depth. */
function drawGround(space, clip, pixels) {
  const {
    graphics,
    graphics: { gl },
    state,
  } = space;
  const marks = { clip, pixels, colours: state.colours.marks, form: FORM.line };
  gl.disable(gl.DEPTH_TEST);
  drawSurface(graphics, space.road, { clip, colour: rgba(state.colours.road) });
  drawMarks(graphics, space.lanes, marks);
  if (state.layers.beam) {
    drawSurface(graphics, space.beam, { clip, colour: [...state.colours.named.c0.slice(0, 3), 0.07] });
    drawMarks(graphics, space.radarLines, marks);
  }
}

function drawBodies(space, clip) {
  const { graphics, state } = space;
  state.frame.bodies.forEach((body, index) => {
    if (body.mesh === null) return;
    const isFaint = state.chosen !== null && state.chosen !== index;
    const colour = toned(
      bodyColour(state.colours, body),
      rgba(state.colours.paper),
      isFaint ? 0.6 : 0.15,
    );
    drawSurface(graphics, space.meshes[body.mesh], {
      clip,
      body: worldFromBody(body.place_m, body.yaw_rad),
      colour,
      shaded: 1,
    });
  });
}

function bodyColour({ named }, body) {
  return named[body.is_clutter ? "clutter" : (body.class ?? "plain")];
}

/** Lines are hidden by the bodies before them; what was detected is not. */
function drawFrameMarks(space, look) {
  const {
    graphics,
    graphics: { gl },
    frame,
    state,
  } = space;
  const chosen = state.chosen ?? -1;
  gl.depthMask(false);
  if (state.layers.paths) drawPaths(space, { ...look, chosen, faint: 0.03 });
  if (state.layers.boxes) drawMarks(graphics, frame.boxes, { ...look, form: FORM.line });
  if (state.layers.tracks) drawMarks(graphics, frame.tracks, { ...look, form: FORM.line });
  gl.depthMask(true);
  gl.disable(gl.DEPTH_TEST);
  drawMarks(graphics, space.radarDot, { ...look, form: FORM.dot });
  if (state.layers.points)
    drawMarks(graphics, frame.points, { ...look, form: FORM.dot, chosen, faint: 0.3 });
  if (state.layers.objects) drawMarks(graphics, frame.objects, { ...look, form: FORM.ring });
}

/** The strongest paths; while the cursor is on the map, those outside of its cell are faint. */
function drawPaths({ graphics, frame, ends, radar, state }, look) {
  const shown = drawnNow(state.moving, state.shown);
  const cursor =
    state.isHeld || state.cursor.source === "map" ? cursorCell({ radar, state }) : undefined;
  const [lines, dots] = ends.map((of) => of[Math.min(shown, of.length - 1)]);
  drawMarks(graphics, frame.pathLines, { ...look, cursor, form: FORM.line, count: lines });
  drawMarks(graphics, frame.pathDots, { ...look, cursor, form: FORM.dot, count: dots });
}

/** Range and velocity of the cursor and how far its cell reaches. */
function cursorCell({ radar, state }) {
  const { range, velocity } = state.cursor;
  return [
    range,
    velocity,
    CURSOR_CELLS * radar.range_resolution_m,
    CURSOR_CELLS * radar.velocity_resolution_mps,
  ];
}

/** The circle on the ground at the cursor's range. */
function drawCursor(space, look) {
  const out = [];
  addLines(out, groundArc(space.radar, space.state.cursor.range), { colour: MARK.c5 });
  const buffer = markBuffer(space.graphics, out);
  drawMarks(space.graphics, buffer, { ...look, form: FORM.line });
  forget(space.graphics, buffer);
}

/** Pixels of the page of a world place; `null` behind the eye. */
function onScreen({ canvas, state }, place) {
  const clip = clipFromWorld(state.camera, canvas.width / canvas.height);
  const along = (row) =>
    clip[row] * place[0] + clip[4 + row] * place[1] + clip[8 + row] * place[2] + clip[12 + row];
  const depth = along(3);
  if (depth <= 0) return null;
  return [
    (canvas.clientWidth * (along(0) / depth + 1)) / 2,
    (canvas.clientHeight * (1 - along(1) / depth)) / 2,
  ];
}

/** The nearest body whose box the ray through a pixel meets; `null` if none. */
function bodyUnder(space, [x, y]) {
  const { canvas, state } = space;
  const at = [(2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight];
  const ray = rayThrough(state.camera, canvas.clientWidth / canvas.clientHeight, at);
  let [best, nearest] = [null, Infinity];
  state.frame.bodies.forEach((body, index) => {
    const distance =
      body.mesh === null
        ? Infinity
        : distanceToBox(ray, body, space.page.surroundings.meshes[body.mesh].box_m);
    if (distance < nearest) [best, nearest] = [index, distance];
  });
  return best;
}

/** Distance along a ray to a body's box; infinite where it misses it. */
function distanceToBox({ from, direction }, body, [low, high]) {
  const start = inBody(from, body.place_m, body.yaw_rad);
  const way = inBody(direction, [0, 0, 0], body.yaw_rad);
  let [enter, leave] = [0, Infinity];
  for (let axis = 0; axis < 3; axis++) {
    const ends = [low[axis], high[axis]]
      .map((end) => (end - start[axis]) / way[axis])
      .sort((a, b) => a - b);
    enter = Math.max(enter, ends[0]);
    leave = Math.min(leave, ends[1]);
  }
  return enter <= leave ? enter : Infinity;
}

/** The detected point or object within a finger's width of a pixel; `null` if none. */
function foundUnder(space, pixel) {
  const { points, objects } = space.state.frame;
  const all = [...points.ranges_m].map((range, i) => ({
    place: points.places_m.slice(3 * i, 3 * i + 3),
    range,
    velocity: points.velocities_mps[i],
  }));
  for (const object of objects)
    all.push({ place: object.place_m, range: object.range_m, velocity: object.velocity_mps });
  let [best, nearest] = [null, 10];
  for (const thing of all) {
    const at = onScreen(space, thing.place);
    const distance = at ? Math.hypot(at[0] - pixel[0], at[1] - pixel[1]) : Infinity;
    if (distance < nearest) [best, nearest] = [thing, distance];
  }
  return best;
}
