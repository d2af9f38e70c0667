// The view in three dimensions: what is on the card, how it is drawn, and what lies under the pointer.

/** Half a cell and a bit, so that the cell of the cursor and its neighbours are bright. */
const CURSOR_CELLS = 1.5;

function makeSpace(canvas, page, state) {
  const graphics = makeGraphics(canvas);
  if (!graphics) return null;
  const { surroundings } = page;
  const { radar } = surroundings;
  return {
    canvas,
    graphics,
    page,
    state,
    radar,
    ...makeSurroundings(graphics, surroundings),
    beam: surfaceOf(graphics, beamSurface(radar)),
    radarLines: markBuffer(graphics, radarLines(radar)),
    radarDot: markBuffer(graphics, radarDot(radar)),
    frame: null,
  };
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
  const { graphics, state } = space;
  const look = beginPicture(space);
  drawGround(space, look);
  graphics.gl.enable(graphics.gl.DEPTH_TEST);
  const isFaint = (index) => state.chosen !== null && state.chosen !== index;
  if (state.layers.bodies) drawBodies(space, look, state.frame.bodies, isFaint);
  drawFrameMarks(space, look);
  drawCursor(space, look);
}

/** The ground is flat and lies below everything: it needs no depth. */
function drawGround(space, look) {
  space.graphics.gl.disable(space.graphics.gl.DEPTH_TEST);
  drawRoad(space, look);
  if (space.state.layers.beam) drawBeam(space, look, space);
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

/** Range and velocity of the cursor, how far its cell reaches, and after what the map repeats; 0: never. */
function cursorCell({ radar, state }) {
  const { range, velocity } = state.cursor;
  const { rows, columns, range_m, velocity_mps } = state.frame.map;
  const [range_step, velocity_step] = [range_m[1], velocity_mps[1]];
  return {
    cell: [range, velocity, CURSOR_CELLS * range_step, CURSOR_CELLS * velocity_step],
    repeats: [radar.ranges_repeat ? columns * range_step : 0, rows * velocity_step],
  };
}

/** The circle on the ground at the cursor's range. */
function drawCursor(space, look) {
  const out = [];
  addLines(out, groundArc(space.radar, space.state.cursor.range), { colour: MARK.c5 });
  const buffer = markBuffer(space.graphics, out);
  drawMarks(space.graphics, buffer, { ...look, form: FORM.line });
  forget(space.graphics, buffer);
}

/** Pixels from a point target within which it is meant. */
const POINT_PIXELS = 10;

/**
 * The nearest body whose box the ray through a pixel meets, or a point target that is nearer and lies within
 * a finger's width of the pixel; `null` if none.
 */
function thingUnder(space, [x, y]) {
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
  const { bodies } = state.frame;
  const pixels = bodies.map(({ mesh, place_m }) => (mesh === null ? onScreen(space, place_m) : null));
  const point = nearestTo([x, y], pixels, POINT_PIXELS);
  if (point === null) return best;
  const away = Math.hypot(...subtract(bodies[point].place_m, ray.from));
  return away < nearest ? point : best;
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
    name: "point",
    place: points.places_m.slice(3 * i, 3 * i + 3),
    range,
    velocity: points.velocities_mps[i],
    height: points.heights[i],
  }));
  for (const { place_m, range_m, velocity_mps, height } of objects)
    all.push({ name: "object", place: place_m, range: range_m, velocity: velocity_mps, height });
  const pixels = all.map(({ place }) => onScreen(space, place));
  return all[nearestTo(pixel, pixels, 10)] ?? null;
}
