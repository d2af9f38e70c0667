// A body as one aspect of an `rcs` table sees it: facets by what they return, and the strongest rays.

/** Levels of facets: 0 returns nothing, the others are dB over the weakest that is coloured. */
const NOTHING = 0;
const SOUND_DB = 40;

function startRcsView() {
  const page = readPage();
  document.getElementById("viewer").hidden = false;
  const camera = { ...makeCamera(), nearest: 0.5, farthest: 400 };
  const state = { page, camera, chosen: null, belowDb: -30, colours: readColours(), layers: {} };
  Object.assign(state, { isHeld: true });
  const space = makeBody(part("space"), page, state);
  if (!space) part("space-place").replaceChildren("This browser has no WebGL 2; the pictures show the body.");
  const view = { page, state, space, isWaiting: false };
  hearRcsControls(view);
  if (space) hearSpace(view);
  chooseRays(view);
  standBefore(view, "side");
  globalThis.waysideViewer = { view, draw: () => drawBodyNow(view), choose: (facet) => choose(view, facet) };
}

/** The body on the card: one surface for each level, so that each has its colour. */
function makeBody(canvas, page, state) {
  const graphics = makeGraphics(canvas);
  if (!graphics) return null;
  const of = Array.from({ length: SOUND_DB + 2 }, () => []);
  page.levels.forEach((level, facet) => of[level].push(...page.triangles.slice(3 * facet, 3 * facet + 3)));
  const surface = (triangles) => triangles.length && surfaceBuffer(graphics, page.corners, triangles);
  const surfaces = of.map(surface);
  const { numbers, ends } = rayMarks(page.rays);
  return { canvas, graphics, state, surfaces, rays: markBuffer(graphics, numbers), ends };
}

/** Lines of the rays, strongest first, and after each how many marks there are. */
function rayMarks(rays) {
  const [numbers, ends] = [[], [0]];
  let corner = 0;
  rays.corners.forEach((corners, i) => {
    const places = [];
    for (const end = corner + corners; corner < end; corner++)
      places.push([0, 1, 2].map((axis) => rays.places[3 * corner + axis]));
    const opacity = Math.max(0.15, 0.9 + rays.levels_db[i] / 45);
    addLines(numbers, places, { colour: Math.min(5, rays.orders[i]), opacity });
    ends.push(numbers.length / FLOATS_OF_A_MARK);
  });
  return { numbers, ends };
}

function drawBodyNow({ space, state }) {
  if (!space) return;
  const { graphics } = space;
  const { gl } = graphics;
  const look = beginPicture(space);
  gl.enable(gl.DEPTH_TEST);
  if (state.layers.body) drawFacets(space, look.clip);
  gl.depthMask(false);
  const count = space.ends[state.shown];
  if (state.layers.rays) drawMarks(graphics, space.rays, { ...look, form: FORM.line, count });
  gl.depthMask(true);
}

function drawFacets({ graphics, surfaces, state }, clip) {
  const plain = toned(state.colours.named.plain, rgba(state.colours.paper), 0.55);
  surfaces.forEach((surface, level) => {
    if (!surface) return;
    const isTold = level > NOTHING && level - 1 - SOUND_DB >= state.belowDb;
    const colour = isTold ? [...heat((level - 1) / SOUND_DB).map((v) => v / 255), 1] : plain;
    drawSurface(graphics, surface, { clip, colour, shaded: isTold ? 0.35 : 1 });
  });
}

/** The facet that the ray through a pixel meets first; `null` if none. */
function thingUnder({ canvas, state }, [x, y]) {
  const at = [(2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight];
  const ray = rayThrough(state.camera, canvas.clientWidth / canvas.clientHeight, at);
  const { corners, triangles } = state.page;
  let [best, nearest] = [null, Infinity];
  for (let facet = 0; facet < triangles.length / 3; facet++) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const first = 3 * triangles[3 * facet + k];
      return [corners[first], corners[first + 1], corners[first + 2]];
    });
    const distance = distanceToFacet(ray, a, subtract(b, a), subtract(c, a));
    if (distance < nearest) [best, nearest] = [facet, distance];
  }
  return best;
}

/** Distance along a ray to a triangle (Möller and Trumbore 1997); infinite where it misses it. */
function distanceToFacet({ from, direction }, corner, first, second) {
  const across = cross(direction, second);
  const area = dot(first, across);
  if (Math.abs(area) < 1e-12) return Infinity;
  const start = subtract(from, corner);
  const u = dot(start, across) / area;
  const along = cross(start, first);
  const v = dot(direction, along) / area;
  const distance = dot(second, along) / area;
  return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 ? distance : Infinity;
}

/** Nothing is found by hovering: `isHeld` keeps the listeners from asking. */
function foundUnder() {
  return null;
}

function choose(view, facet) {
  view.state.chosen = facet;
  const panel = part("panel");
  panel.replaceChildren();
  const of = facet === null ? allRays(view.page) : raysThrough(view.page, facet);
  put(panel, "h3", facet === null ? "The strongest sequences" : `Facet ${view.page.numbers[facet]}`);
  if (facet !== null) put(panel, "p", toldOfFacet(view.page, facet));
  fillTable(panel, view.page, of.slice(0, 12));
  redraw(view);
}

function toldOfFacet({ levels, strongest_dbsm: strongest }, facet) {
  if (levels[facet] === NOTHING) return "Contributes to no sequence within 40 dB of the strongest.";
  return `Its sequences' powers together: ${told(strongest + levels[facet] - 1 - SOUND_DB, 0, "dBsm")}.`;
}

const allRays = ({ rays }) => [...rays.orders.keys()];

function raysThrough({ rays, numbers }, facet) {
  let at = 0;
  return allRays({ rays }).filter((i) => {
    const own = rays.facets.slice(at, (at += rays.facet_counts[i]));
    return own.includes(numbers[facet]);
  });
}

function fillTable(panel, { rays, strongest_dbsm: strongest }, of) {
  if (!of.length) return;
  const table = put(panel, "table");
  const head = put(table, "tr");
  ["rank", "bounces", "dBsm", "facets"].forEach((name) => put(head, "th", name));
  const starts = [0];
  rays.facet_counts.forEach((count) => starts.push(starts.at(-1) + count));
  for (const i of of) {
    const row = put(table, "tr");
    const facets = [...rays.facets.slice(starts[i], starts[i + 1])].join(", ");
    const level = told(strongest + rays.levels_db[i], 1);
    [`${i + 1}`, `${rays.orders[i]}`, level, facets].forEach((text) => put(row, "td", text));
  }
}

function chooseRays(view) {
  const { page, state } = view;
  state.belowDb = part("level").valueAsNumber;
  const { levels_db: levels } = page.rays;
  state.shown = [...levels].filter((level) => level >= state.belowDb).length;
  const power = levels.slice(0, state.shown).reduce((sum, level) => sum + 10 ** (level / 10), 0);
  const left = Math.max(0, 100 * (1 - power / page.all_power));
  part("level-told").textContent =
    ` ${told(state.belowDb, 0)} dB of the strongest: ${counted(state.shown, "sequence", "sequences")} of ` +
    `${counted(page.all_sequences, "", "").trim()}, ${told(left, 1)} % of their powers left out`;
  tellOfBounces(view);
  choose(view, state.chosen);
}

/** How many of the shown sequences have how many bounces, in the colours of their lines. */
function tellOfBounces({ page, state }) {
  const place = part("orders");
  place.replaceChildren();
  const shown = [...page.rays.orders.slice(0, state.shown)];
  for (const order of [...new Set(shown)].sort()) {
    const label = put(place, "span");
    put(label, "i", "", MARKS[Math.min(5, order)]);
    const count = shown.filter((own) => own === order).length;
    label.append(`${counted(order, "bounce", "bounces")}: ${count}`);
  }
}

function hearRcsControls(view) {
  part("level").addEventListener("input", () => chooseRays(view));
  hearSurroundings(view, (place) => standBefore(view, place));
}

/** Stands the eye aside of the radar's line of sight, in it, or above; all of the body is seen. */
function standBefore(view, place) {
  const { camera } = view.state;
  const { direction, box } = view.page;
  const corners = boxCorners(box);
  const ahead = Math.atan2(-direction[0], -direction[1]);
  const at = [0, 1, 2].map((axis) => (box[0][axis] + box[1][axis]) / 2);
  const [azimuth, elevation] = {
    side: [ahead - 0.9, 0.4],
    radar: [ahead, Math.min(STEEPEST_RAD, Math.asin(direction[2]))],
    above: [ahead, STEEPEST_RAD],
  }[place];
  Object.assign(camera, { at, azimuth, elevation });
  const { clientWidth, clientHeight } = part("space-place");
  const aspect = clientWidth / Math.max(1, clientHeight);
  standBack(camera, aspect, corners);
  redraw(view);
}

const move = redraw;

function redraw(view) {
  atNextPicture(view, () => {
    drawBodyNow(view);
    drawAzimuthCut(view);
  });
}

/** Level over azimuth, with the aspect that is shown. */
function drawAzimuthCut({ page, state }) {
  const { azimuths_deg: azimuths, levels_dbsm: levels } = page.cut;
  if (azimuths.length < 2) return;
  const [lowest, highest] = [Math.min(...levels), Math.max(...levels)];
  const from = 10 * Math.floor(Math.max(highest - 60, lowest - 1) / 10);
  const y = { from, to: 10 * Math.ceil((highest + 1) / 10) };
  const sheet = sheetOf(part("cut"), { from: azimuths[0], to: azimuths.at(-1) }, y);
  clearSheet(sheet, state.colours);
  const points = azimuths.map((azimuth, i) => [azimuth, levels[i]]);
  trace(sheet, points, cssColour(state.colours.named.c0), 1.4);
  upright(sheet, page.azimuth_deg, state.colours);
  drawAxes(sheet, state.colours, "azimuth, degrees", "|S|², dBsm");
}

startRcsView();
