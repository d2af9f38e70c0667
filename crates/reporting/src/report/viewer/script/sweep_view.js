// Designs of a study where they stand, over the road and the vehicles that they were tried on: a dot for each
// design, coloured by a metric; the chosen one shows its field of view and all that it was worth.

/** Colours of dots, from the worst to the best: as many as marks have. */
const STEPS = MARKS.length;
/** Distance between dots of designs that stand in one place, m. */
const APART_M = 0.7;
const DOT = 11;
/** Pixels from a dot within which a click means it. */
const FINGER = 14;

function startSweepView() {
  const page = readPage();
  document.getElementById("viewer").hidden = false;
  const state = {
    page,
    camera: makeCamera(),
    colours: readColours(),
    layers: {},
    metric: page.goal,
    across: page.cost,
    situation: 0,
    isAlone: false,
    chosen: page.answer ?? 0,
    isHeld: true,
  };
  const space = makeStudy(part("space"), page, state);
  if (!space)
    part("space-place").replaceChildren("This browser has no WebGL 2; the chart below shows the designs.");
  const view = { page, state, space, isWaiting: false, names: [] };
  hearSweepControls(view);
  if (space) hearSpace(view);
  chooseSituation(view);
  choose(view, state.chosen);
  standBy(view, "around");
  globalThis.waysideViewer = {
    view,
    draw: () => drawStudy(view),
    choose: (design) => choose(view, design),
    pixelOf: (design) => onScreen(space, space.places[design]),
    pixelOnChart: (design) => pixelOnChart(state, design),
  };
}

function makeStudy(canvas, page, state) {
  const graphics = makeGraphics(canvas);
  if (!graphics) return null;
  const surroundings = makeSurroundings(graphics, page.surroundings);
  const poles = [];
  for (const { position_m: at } of page.radars)
    addLine(poles, [at[0], at[1], 0], at, { colour: MARK.c6, opacity: 0.6 });
  return {
    canvas,
    graphics,
    page,
    state,
    ...surroundings,
    places: placesOfDesigns(page),
    poles: markBuffer(graphics, poles),
    dots: null,
  };
}

/** Places of the dots: designs that stand in one place are side by side in rows, across their boresight. */
function placesOfDesigns({ designs, radars }) {
  const together = Map.groupBy(designs.keys(), (i) => radars[designs[i].radar].position_m.join());
  const places = [];
  for (const group of together.values()) {
    const columns = Math.ceil(Math.sqrt(2 * group.length));
    group.forEach((design, i) => {
      const radar = radars[designs[design].radar];
      const across = [Math.cos(radar.boresight_az_rad), -Math.sin(radar.boresight_az_rad), 0];
      const inRow = Math.min(columns, group.length - columns * Math.floor(i / columns));
      const side = APART_M * ((i % columns) - (inRow - 1) / 2);
      const up = APART_M * Math.floor(i / columns);
      places[design] = add(add(radar.position_m, across, side), [0, 0, 1], up);
    });
  }
  return places;
}

/** The worth of a design by the metric that is shown; `null` where it is not known. */
function worthOf({ page, metric, isAlone, situation }, design) {
  if (isAlone) return page.designs[design].goal_by_situation[situation] ?? null;
  return page.designs[design].means[metric]?.[0] ?? null;
}

/** The worst and the best that any design is worth. */
function endsOfWorth(state) {
  const { page } = state;
  const all = [...page.designs.keys()].map((i) => worthOf(state, i)).filter((value) => value !== null);
  if (!all.length) return null;
  const [low, high] = [Math.min(...all), Math.max(...all)];
  return page.metrics[metricShown(state)].is_lower_better ? [high, low] : [low, high];
}

/** One situation alone is told by the goal's metric. */
const metricShown = ({ page, metric, isAlone }) => (isAlone ? page.goal : metric);

/** Share of the way from the worst to the best, 0 to 1; `null` of what is not known. */
function shareOf(state, ends, design) {
  const value = worthOf(state, design);
  if (value === null || !ends) return null;
  return ends[1] === ends[0] ? 1 : (value - ends[0]) / (ends[1] - ends[0]);
}

/** The palette of dots leaves out what is as dark or as bright as a page. */
const toneOf = (share) => heat(0.15 + 0.75 * share);
const PALETTE = Array.from({ length: STEPS }, (_, i) => [
  ...toneOf(i / (STEPS - 1)).map((value) => value / 255),
  1,
]).flat();

/** Puts the designs' dots on the card: a rim for all, a disc in its colour where the metric is known. */
function putDots({ space, state }) {
  if (!space) return;
  for (const buffer of Object.values(space.dots ?? {})) forget(space.graphics, buffer);
  const [rims, discs, ring] = [[], [], []];
  const ends = endsOfWorth(state);
  space.places.forEach((place, design) => {
    const share = shareOf(state, ends, design);
    addMark(rims, place, { colour: MARK.c6, size: DOT + 3 });
    if (share !== null) addMark(discs, place, { colour: Math.round(share * (STEPS - 1)), size: DOT });
  });
  addMark(ring, space.places[state.chosen], { colour: MARK.found, size: DOT + 16 });
  space.dots = Object.fromEntries(
    Object.entries({ rims, discs, ring }).map(([name, marks]) => [name, markBuffer(space.graphics, marks)]),
  );
}

function drawStudy({ space, names, state }) {
  if (!space) return;
  const { graphics, page } = space;
  const { gl } = graphics;
  const look = beginPicture(space);
  gl.disable(gl.DEPTH_TEST);
  drawRoad(space, look);
  if (state.layers.beam) drawBeam(space, look, beamOf(space, page.designs[state.chosen].radar));
  gl.enable(gl.DEPTH_TEST);
  if (state.layers.bodies) drawBodies(space, look, page.situations[state.situation].bodies, () => false);
  gl.depthMask(false); // poles of designs in one place hide no part of each other
  drawMarks(graphics, space.poles, { ...look, form: FORM.line });
  gl.depthMask(true);
  gl.disable(gl.DEPTH_TEST);
  if (state.layers.designs) drawDots(space, look);
  placeNames({ names, space, state });
}

function drawDots({ graphics, dots }, look) {
  drawMarks(graphics, dots.rims, { ...look, form: FORM.dot });
  drawMarks(graphics, dots.discs, { ...look, form: FORM.dot, colours: PALETTE });
  drawMarks(graphics, dots.ring, { ...look, form: FORM.ring });
}

/** The field of view of a radar, made when it is shown first. */
function beamOf(space, radar) {
  space.beams ??= new Map();
  if (!space.beams.has(radar)) {
    const of = space.page.radars[radar];
    const beam = surfaceOf(space.graphics, beamSurface(of));
    space.beams.set(radar, { beam, radarLines: markBuffer(space.graphics, radarLines(of)) });
  }
  return space.beams.get(radar);
}

/** The design whose dot is nearest to a pixel; `null` where none is near. */
function thingUnder(space, pixel) {
  const pixels = space.places.map((place) => onScreen(space, place));
  return nearestTo(pixel, pixels, FINGER);
}

/** Nothing is found by hovering: `isHeld` keeps the listeners from asking. */
function foundUnder() {
  return null;
}

/** Chooses a design; a click beside all of them changes nothing. */
function choose(view, design) {
  const { page, state } = view;
  if (design === null) return;
  state.chosen = design;
  part("design").value = String(design);
  tellOfDesign(part("panel"), page, design);
  putDots(view);
  nameThings(view);
  redraw(view);
}

function chooseSituation(view) {
  const { page, state } = view;
  state.situation = part("situation").valueAsNumber;
  state.isAlone = part("alone").checked;
  const { words } = page.situations[state.situation];
  part("situation-told").textContent = ` ${state.situation + 1} of ${page.situations_all}: ${words}`;
  chooseMetric(view);
}

function chooseMetric(view) {
  const { page, state } = view;
  state.metric = Number(part("metric").value);
  state.across = Number(part("across").value);
  part("metric").disabled = state.isAlone;
  const ends = endsOfWorth(state);
  const { name } = page.metrics[metricShown(state)];
  const over = state.isAlone ? "in this situation alone" : "mean over the situations";
  part("scale-told").textContent = ` ${name}, ${over}: ${toldOfEnds(ends)}`;
  putDots(view);
  nameThings(view);
  redraw(view);
}

function toldOfEnds(ends) {
  if (!ends) return "known of no design";
  const [worst, best] = ends.map(shortly);
  return worst === best ? `${best} of all designs` : `from ${worst}, the worst, to ${best}, the best`;
}

/** A number with three digits that tell. */
function shortly(value) {
  return value === 0 ? "0" : told(value, Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value)))));
}

/** Names over the picture: vehicles, lanes, and the chosen design. */
function nameThings(view) {
  const { page, state, space } = view;
  if (!space) return;
  const place = part("names");
  place.replaceChildren();
  const name = (words, at) => view.names.push({ element: put(place, "span", words), at });
  view.names = [];
  name(`design ${page.designs[state.chosen].number}`, add(space.places[state.chosen], [0, 0, 1], 0.6));
  const { lanes, meshes } = page.surroundings;
  for (const body of page.situations[state.situation].bodies) {
    const top = body.mesh === null ? 0 : meshes[body.mesh].box_m[1][2];
    name(body.id, add(body.place_m, [0, 0, 1], top + 0.4));
  }
  for (const lane of lanes) name(lane.name, [...lane.at_m, 0]);
}

function hearSweepControls(view) {
  for (const name of ["situation", "alone"])
    part(name).addEventListener("input", () => chooseSituation(view));
  for (const name of ["metric", "across"]) part(name).addEventListener("input", () => chooseMetric(view));
  part("design").addEventListener("input", () => choose(view, Number(part("design").value)));
  for (const button of document.querySelectorAll("#viewer [data-design]"))
    button.addEventListener("click", () => choose(view, Number(button.dataset.design)));
  part("chart").addEventListener("click", ({ offsetX, offsetY }) =>
    choose(view, designOnChart(view.state, [offsetX, offsetY])),
  );
  hearSurroundings(view, (place) => standBy(view, place));
}

/** Stands the eye where the designs and the vehicles are seen, behind the chosen radar, or above. */
function standBy(view, place) {
  const { page, state } = view;
  const radar = page.radars[page.designs[state.chosen].radar];
  const poles = page.radars.flatMap(({ position_m: at }) => [at, [at[0], at[1], 0]]);
  const { meshes } = page.surroundings;
  const bodies = page.situations[state.situation].bodies.flatMap((body) => cornersOf(body, meshes));
  const { clientWidth, clientHeight } = part("space-place");
  standAt(state.camera, place, radar, [...poles, ...bodies], clientWidth / Math.max(1, clientHeight));
  redraw(view);
}

const move = redraw;

function redraw(view) {
  atNextPicture(view, () => {
    drawStudy(view);
    drawChart(view.state);
  });
}

startSweepView();
