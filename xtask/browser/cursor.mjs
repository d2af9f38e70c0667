// The cursor that map, cuts and picture share, the mask on the map, and paths that fade beside the cursor.

import { pause } from "./chromium.mjs";
import { PIXELS, RECT, TEXT, settled, slide } from "./looks.mjs";
import { holds } from "./tally.mjs";

const CURSOR = "waysideViewer.view.state.cursor";
const pixelOnMap = (range, velocity) => `waysideViewer.pixelOnMap(${range}, ${velocity})`;

/** Points at a cell of the map; gives its pixel. */
async function pointAtMap(page, { range, velocity }) {
  const box = await page.value(RECT("map"));
  const [x, y] = await page.value(pixelOnMap(range, velocity));
  await page.mouse("mouseMoved", box.x + x, box.y + y);
  await settled(page);
  return [x, y];
}

export async function cursorIsShared(page) {
  const target = await page.value("waysideViewer.view.state.frame.objects[0]");
  await pointAtMap(page, { range: target.range_m, velocity: target.velocity_mps });
  const text = await page.value(TEXT("readout"));
  const cursor = await page.value(CURSOR);
  const isNear = cursor && Math.abs(cursor.range - target.range_m) < 1;
  holds("reads range and velocity under the pointer", isNear, [cursor, target]);
  holds("tells level, verdict and whose echo", /dB over the noise, .*echo of /.test(text), text);
}

/** Each cut sets its own part of the cursor, and a click holds it. */
export async function cutsMoveTheCursor(page) {
  for (const [name, moved, kept] of [
    ["range", "range", "velocity"],
    ["doppler", "velocity", "range"],
  ]) {
    const box = await page.value(RECT(name));
    const at = (share) => [box.x + share * box.width, box.y + share * box.height];
    const seen = [await page.value(CURSOR)];
    for (const share of [0.6, 0.4]) {
      await page.mouse("mouseMoved", ...at(share));
      await pause(100);
      seen.push(await page.value(CURSOR));
    }
    const isMoved = new Set(seen.slice(1).map((of) => of[moved])).size === 2;
    const isKept = seen.every((of) => of[kept] === seen[0][kept]);
    holds(`moves the cursor by the ${name} cut`, isMoved && isKept, seen);
    await page.click(...at(0.4));
    await page.mouse("mouseMoved", ...at(0.6));
    await pause(100);
    const held = await page.value(CURSOR);
    holds(`holds the cursor by a click on the ${name} cut`, held[moved] === seen[2][moved], [seen, held]);
    await page.click(...at(0.6));
  }
}

// Sides between a detected cell and one that is not, and which of them change when the mask is emptied. A
// side at the map's edge is half hidden: it is not asked for. Objects would hide others.
const OUTLINES = `(async () => {
  const { frame } = waysideViewer.view.state;
  const { map, objects } = frame;
  const { mask, rows, columns, range_m: [r0, dr], velocity_mps: [v0, dv] } = map;
  frame.objects = [];
  const drawn = await look.redrawn("map");
  map.mask = mask.map(() => 0);
  const bare = await look.redrawn("map");
  Object.assign(frame, { objects });
  Object.assign(map, { mask });
  await look.redrawn("map");
  const middle = (row, column) => waysideViewer.pixelOnMap(r0 + column * dr, v0 + row * dv);
  const [first, last] = [middle(0, 0), middle(rows - 1, columns - 1)];
  const half = [(last[0] - first[0]) / (columns - 1) / 2, (last[1] - first[1]) / (rows - 1) / 2];
  const isTaken = (row, column) => mask[row * columns + column] === 2;
  const isInside = (row, column) => row >= 0 && row < rows && column >= 0 && column < columns;
  const sides = [];
  mask.forEach((value, cell) => {
    if (value !== 2) return;
    const [row, column] = [Math.floor(cell / columns), cell % columns];
    for (const [up, right] of [[0, -1], [0, 1], [-1, 0], [1, 0]]) {
      if (isInside(row + up, column + right) && isTaken(row + up, column + right)) continue;
      const [x, y] = middle(row, column);
      const at = [x + right * half[0], y + up * half[1]];
      sides.push({ at, isWhole: isInside(row + up, column + right) });
    }
  });
  const near = (x, y) => sides.some(({ at }) =>
    Math.abs(x - at[0]) < Math.abs(half[0]) + 2 && Math.abs(y - at[1]) < Math.abs(half[1]) + 2);
  let elsewhere = 0;
  for (let i = 0; i < drawn.data.length; i += 4) {
    const isSame = [0, 1, 2].every((c) => drawn.data[i + c] === bare.data[i + c]);
    const [x, y] = [(i / 4) % drawn.width, Math.floor(i / 4 / drawn.width)];
    if (!isSame && !near(x + 0.5, y + 0.5)) elsewhere++;
  }
  const whole = sides.filter(({ isWhole }) => isWhole);
  const outlined = whole.filter(({ at }) => look.differs(drawn.data, bare.data, at, drawn.width));
  const cyan = look.moved(bare.data, drawn.data, [[0x39, 0xd0, 0xff]]);
  return { sides: whole.length, outlined: outlined.length, elsewhere, cyan };
})()`;

export async function maskIsOutlined(page) {
  const seen = await page.value(OUTLINES);
  const isAll = seen.sides > 0 && seen.outlined === seen.sides && seen.cyan.towards > 0;
  holds("outlines the cells that the detector took, and no others", isAll && seen.elsewhere === 0, seen);
}

// Places along the ground at the cursor's range, ahead of the radar, as pixels of the picture.
const CIRCLE = `((range) => {
  const { position_m: [x, y, height], boresight_az_rad: ahead, half_angles_rad: [left, right] } =
    waysideViewer.view.page.surroundings.radar;
  const radius = Math.sqrt(range * range - height * height);
  const { canvas } = waysideViewer.view.space;
  const places = Array.from({ length: 9 }, (_, i) => {
    const azimuth = ahead - 0.4 * left + (0.4 * (left + right) * i) / 8;
    const place = [x + radius * Math.sin(azimuth), y + radius * Math.cos(azimuth), 0.03];
    return waysideViewer.pixelOfPlace(place);
  });
  const sides = [canvas.width, canvas.height];
  const isSeen = (at) => at && at.every((pixel, axis) => pixel > 2 && pixel < sides[axis] - 3);
  return places.filter(isSeen).map(([px, py]) => [px, canvas.height - 1 - py]);
})`;

// Columns, or rows, of a canvas in which more than three tenths of the pixels changed: where a line is or was.
const LINES = `((before, after, isUpright) => {
  const { width, height } = after;
  const [across, along] = isUpright ? [width, height] : [height, width];
  const found = [];
  for (let a = 0; a < across; a++) {
    let changed = 0;
    for (let b = 0; b < along; b++) {
      const at = 4 * (isUpright ? b * width + a : a * width + b);
      if ([0, 1, 2].some((c) => before.data[at + c] !== after.data[at + c])) changed++;
    }
    if (changed > 0.3 * along) found.push(a);
  }
  return found;
})`;

const TAKE = (name) => `globalThis.${name} = {
  map: look.canvas("map"), range: look.canvas("range"), doppler: look.canvas("doppler"),
  space: ${PIXELS}([]),
}, null`;

/** Whether lines are where they were and are now, within 2 pixels, and nowhere else. */
function areAt(found, places) {
  const isNear = (a, b) => Math.abs(a + 0.5 - b) <= 2;
  return (
    places.every((place) => found.some((line) => isNear(line, place))) &&
    found.every((line) => places.some((place) => isNear(line, place)))
  );
}

/** Two cells of the map apart in both, not at its edges. */
const CELLS = `(() => {
  const { range_m: [r0, dr], velocity_mps: [v0, dv], rows, columns } = waysideViewer.view.state.frame.map;
  const at = (share) => ({
    range: r0 + Math.round(share * columns) * dr,
    velocity: v0 + Math.round(share * rows) * dv,
  });
  return [at(0.4), at(0.7)];
})()`;

/** One cursor on map, range profile, Doppler cut and in the picture: all four are looked at. */
export async function cursorIsDrawn(page) {
  const cells = await page.value(CELLS);
  const before = await pointAtMap(page, cells[0]);
  await page.value(TAKE("seenBefore"));
  const now = await pointAtMap(page, cells[1]);
  await page.value(TAKE("seenAfter"));
  const [columns, rows] = [0, 1].map((axis) => [before[axis], now[axis]]);
  const lines = (name, isUpright) =>
    page.value(`${LINES}(seenBefore.${name}, seenAfter.${name}, ${isUpright})`);
  const onMap = [await lines("map", true), await lines("map", false)];
  const isOnMap = areAt(onMap[0], columns) && areAt(onMap[1], rows);
  holds("draws the cursor as a cross on the map", isOnMap, [onMap, columns, rows]);
  const onProfile = await lines("range", true);
  holds("draws the cursor in the range profile", areAt(onProfile, columns), [onProfile, columns]);
  const onCut = await lines("doppler", false);
  holds("draws the cursor in the Doppler cut", areAt(onCut, rows), [onCut, rows]);
  const circles = await page.value(`[${cells[0].range}, ${cells[1].range}].map((range) => {
    const places = ${CIRCLE}(range);
    const { width } = waysideViewer.view.space.canvas;
    const drawn = places.filter((at) => look.differs(seenBefore.space, seenAfter.space, at, width));
    return { places: places.length, drawn: drawn.length };
  })`);
  const areDrawn = circles.every(({ places, drawn }) => places > 0 && drawn === places);
  holds("draws the cursor as a circle on the ground of the picture", areDrawn, circles);
  const own = await page.value("look.moved(seenBefore.space, seenAfter.space, [look.mark('c5')])");
  holds("draws that circle in a colour of its own", own.towards > 20, own);
  await page.value("look.layers(), null");
}

// An object away from the cursor whose pixel in the picture no name covers.
const HOVERED = `(() => {
  const { view } = waysideViewer;
  const { canvas } = view.space;
  const { x, y } = canvas.getBoundingClientRect();
  const isFree = (at) => at && document.elementFromPoint(x + at[0], y + at[1]) === canvas;
  const objects = view.state.frame.objects.map(({ place_m, range_m, velocity_mps }) =>
    ({ at: waysideViewer.pixelOfPlace(place_m), range_m, velocity_mps }));
  const isApart = ({ range_m }) => Math.abs(range_m - view.state.cursor.range) > 2;
  const found = objects.find((object) => isApart(object) && isFree(object.at));
  return found && { ...found, at: [x + found.at[0], y + found.at[1]] };
})()`;

export async function hoverMovesTheCursor(page) {
  const [cell] = await page.value(CELLS);
  await pointAtMap(page, cell);
  await page.value(RECT("space"));
  await settled(page);
  const was = await page.value(CURSOR);
  const before = await page.value(pixelOnMap(was.range, was.velocity));
  const object = await page.value(HOVERED);
  await page.value(TAKE("seenBefore"));
  await page.mouse("mouseMoved", ...object.at);
  await settled(page);
  const cursor = await page.value(CURSOR);
  const isNear = cursor.source === "space" && Math.abs(cursor.range - object.range_m) < 1;
  holds("moves the cursor to an object under the pointer in the picture", isNear, [cursor, object]);
  await page.value(TAKE("seenAfter"));
  await page.value("look.layers(), null");
  const now = await page.value(pixelOnMap(cursor.range, cursor.velocity));
  const lines = await page.value(`${LINES}(seenBefore.map, seenAfter.map, true)`);
  holds("moves the map's cursor too", areAt(lines, [before[0], now[0]]), [lines, before, now]);
}

// How much the paths change the picture behind them, colour by colour.
const POWER_OF_PATHS = `(() => {
  const [behind, over] = [${PIXELS}([]), ${PIXELS}(["paths"])];
  look.layers();
  let sum = 0;
  for (let i = 0; i < over.length; i++) sum += Math.abs(over[i] - behind[i]);
  return sum;
})()`;

// Cell of the strongest path, and the cell farthest from those of all paths.
const CELLS_OF_PATHS = `(() => {
  const { frame, shown } = waysideViewer.view.state;
  const { map, paths } = frame;
  const { range_m: [r0, dr], velocity_mps: [v0, dv], rows, columns } = map;
  const cells = Array.from({ length: shown }, (_, i) =>
    [(paths.ranges_m[i] - r0) / dr, (paths.velocities_mps[i] - v0) / dv]);
  const distance = (range, velocity) => Math.min(...cells.map(([r, v]) => {
    const turned = Math.abs(v - velocity) % rows;
    return Math.max(Math.abs(r - range), Math.min(turned, rows - turned));
  }));
  let [empty, farthest] = [null, 0];
  for (let row = 4; row < rows - 4; row += 4)
    for (let column = 4; column < columns - 4; column += 4) {
      const apart = distance(column, row);
      if (apart <= farthest) continue;
      farthest = apart;
      empty = { range: r0 + column * dr, velocity: v0 + row * dv };
    }
  return { farthest, empty, strongest: { range: paths.ranges_m[0], velocity: paths.velocities_mps[0] } };
})()`;

/** Away from the map all paths are bright; at a cell those of other cells are faint. */
export async function pathsFade(page) {
  await page.value("waysideViewer.choose(null)");
  await page.value(slide("level", -30));
  const { farthest, empty, strongest } = await page.value(CELLS_OF_PATHS);
  await pointAtMap(page, empty);
  const atEmpty = await page.value(POWER_OF_PATHS);
  await pointAtMap(page, strongest);
  const atStrongest = await page.value(POWER_OF_PATHS);
  const box = await page.value(RECT("map"));
  await page.mouse("mouseMoved", box.x + 200, box.y - 20);
  await settled(page);
  const away = await page.value(POWER_OF_PATHS);
  const seen = { farthest, atEmpty, atStrongest, away };
  // Paths of other cells have 0.03 of their opacity.
  holds("lets the paths of other cells fade", farthest > 2 && atEmpty < 0.1 * away, seen);
  holds("keeps the paths of the cursor's cell", atStrongest > 2 * atEmpty && atStrongest <= away, seen);
}
