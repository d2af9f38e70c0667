// Sentences about what the view shows, what it leaves out, and what is under the cursor.

/** What the page holds of the run, and what it leaves out. */
function tellOfRun({ page, state }) {
  const words = page.surroundings.radar.words;
  const sentences = [
    page.every > 1 && `This page holds every ${ordinal(page.every)} of ${page.frames_all} frames.`,
    ...(state.frame.paths ? sentencesOnPaths(state.frame.paths) : []),
    ...sentencesOnMap(state.frame.map),
    sentenceOnHeights(state.frame),
    sentenceOnMeshes(page.surroundings.meshes),
    `${words[0].toUpperCase()}${words.slice(1)}.`,
  ];
  part("told").textContent = sentences.filter(Boolean).join(" ");
}

function sentencesOnPaths(paths) {
  const kept = paths.levels_dbw.length;
  const out = percent(shareBehind(paths, kept));
  const [some, all] = [kept.toLocaleString("en"), paths.all.toLocaleString("en")];
  const bent = counted(paths.through_middles, "path is", "paths are");
  const whole = WITH_LEGS.toLocaleString("en");
  return [
    kept < paths.all &&
      `This page holds the strongest ${some} of ${all} paths; the others carry ${out} of the power.`,
    kept > WITH_LEGS &&
      `The strongest ${whole} paths are drawn in full, the others only between their reflections.`,
    paths.through_middles > 0 &&
      `${bent} drawn through facet centres, because curved skin bends them.`,
  ];
}

function sentencesOnMap({ pooled, floor_is_assumed }) {
  return [
    pooled > 1 && `Each cell of the map shows the strongest of ${pooled} × ${pooled} cells.`,
    floor_is_assumed && "The scene has no noise: a floor 60 dB below the peak is assumed.",
  ];
}

/** What a height is, in the order in which viewed_frame.rs counts what it stands on. */
const HEIGHTS = ["measured", "assumed, not measured", "the radar's own, not measured"];
const [MEASURED, RADARS_OWN] = [0, 2];

/** Where points and objects stand though nobody measured how high. */
function sentenceOnHeights({ assumed_height_m, points, objects }) {
  const heights = [...points.heights, ...objects.map(({ height }) => height)];
  if (heights.every((height) => height === MEASURED)) return false;
  const own = heights.filter((height) => height === RADARS_OWN).length;
  const assumed = assumed_height_m !== null && `at an assumed height of ${assumed_height_m} m`;
  const some = assumed ? `${own.toLocaleString("en")} of them ` : "";
  const places = [assumed, own > 0 && `${some}at the radar's own height`].filter(Boolean);
  return `The array does not measure heights: points and objects are drawn ${places.join(", ")}.`;
}

function sentenceOnMeshes(meshes) {
  const boxes = meshes.filter((mesh) => !mesh.corners_m).length;
  return (
    boxes > 0 && `${counted(boxes, "mesh is", "meshes are")} too large for this page and drawn as boxes.`
  );
}

function tellOfOrders({ state }) {
  const place = part("orders");
  place.replaceChildren();
  const { paths } = state.frame;
  if (!paths) return;
  for (const [order, { paths: count }] of ordersOf(paths, state.shown)) {
    const item = put(place, "span");
    put(item, "i", "", MARKS[Math.min(5, order)]);
    item.append(`${ORDER_NAMES[order]}: ${count.toLocaleString("en")} `);
  }
}

/** Description of the cell under the cursor. */
function readout({ cursor, frame }) {
  const { map } = frame;
  const { row, column } = cellOf(map, cursor);
  const cell = row * map.columns + column;
  const verdict = ["not tested", "below the threshold", "detected"][map.mask[cell]];
  const velocity = map.velocity_mps[0] + row * map.velocity_mps[1];
  return (
    `${told(map.range_m[0] + column * map.range_m[1], 2, "m")}, ${told(velocity, 2, "m/s")}: ` +
    `${told(map.levels_db[cell], 1, "dB over the noise")}, ${verdict}; ${whose(frame, cell)}.` +
    toldOfThing(cursor)
  );
}

/** Description of the point or the object on which the cursor was set. */
function toldOfThing({ found }) {
  if (!found) return "";
  const height = told(found.place[2], 2, "m");
  return ` Height of the ${found.name}: ${height}, ${HEIGHTS[found.height]}.`;
}

const ROAD = 0xffffffff;

/** The kind of echo that fills a cell most. */
function whose({ map, bodies, paths }, cell) {
  if (!paths) return "source unknown: echoes come from RCS tables";
  const kind = map.kinds[map.strongest[cell] - 1];
  if (!kind) return "no echo above the noise";
  const name = kind.target === ROAD ? "the road" : (bodies[kind.target]?.id ?? "a body");
  const over = kind.bodies > 1 ? `, over ${kind.bodies} bodies` : "";
  const share = `${map.percent[cell]} % of the echoes' power there`;
  return `echo of ${name}, ${ORDER_NAMES[kind.order]}${over} (${share})`;
}
