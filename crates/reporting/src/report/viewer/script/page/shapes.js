// Shapes of what stands about: road, lanes, radar with its field of view, boxes, points, objects, tracks.

const ROAD_HEIGHT_M = 0.01;
const LINE_HEIGHT_M = 0.03;
/** Corners of a box by bits: x, y, z; and its edges. */
const EDGES = [
  [0, 1],
  [2, 3],
  [4, 5],
  [6, 7],
  [0, 2],
  [1, 3],
  [4, 6],
  [5, 7],
  [0, 4],
  [1, 5],
  [2, 6],
  [3, 7],
];
const FACES = [
  0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3,
  7, 5,
];

/** Adds a mark; look: colour, body, range, velocity, size, opacity. */
function addMark(out, [x, y, z], look) {
  const { body = -1, range = 0, velocity = 0, size = 1, opacity = 1 } = look;
  out.push(x, y, z, look.colour, body, range, velocity, size, opacity);
}

function addLine(out, from, to, look) {
  addMark(out, from, look);
  addMark(out, to, look);
}

function addLines(out, places, look) {
  for (let i = 1; i < places.length; i++) addLine(out, places[i - 1], places[i], look);
}

/** Triangles of roads, each a left and a right side. */
function roadSurface(roads) {
  const [corners, triangles] = [[], []];
  for (const [left, right] of roads) {
    for (let i = 1; i < Math.min(left.length, right.length); i++) {
      const first = corners.length / 3;
      for (const [x, y] of [left[i - 1], left[i], right[i], right[i - 1]])
        corners.push(x, y, ROAD_HEIGHT_M);
      triangles.push(first, first + 1, first + 2, first, first + 2, first + 3);
    }
  }
  return { corners, triangles };
}

/** Places along an arc on the ground at a range from the radar; none where that is less than its height. */
function groundArc(radar, range, steps = 96) {
  const [x, y, height] = radar.position_m;
  const [left, right] = radar.half_angles_rad;
  if (range <= height) return [];
  const radius = Math.sqrt(range * range - height * height);
  return Array.from({ length: steps + 1 }, (_, i) => {
    const azimuth = radar.boresight_az_rad - left + ((left + right) * i) / steps;
    return [x + radius * Math.sin(azimuth), y + radius * Math.cos(azimuth), LINE_HEIGHT_M];
  });
}

/** The field of view on the ground as a fan of triangles. */
function beamSurface(radar) {
  const [x, y] = radar.position_m;
  const rim = groundArc(radar, radar.range_max_m);
  const triangles = rim.slice(1).flatMap((_, i) => [0, i + 1, i + 2]);
  return { corners: [x, y, LINE_HEIGHT_M, ...rim.flat()], triangles };
}

/** Ranges of the circles on the ground: every 20 m, or of long ranges every 50, 100, 200 and so on. */
function circleRanges(range_max_m) {
  const most = 20;
  let step = 20;
  for (let i = 0; range_max_m / step > most; i++) step *= i % 3 === 0 ? 2.5 : 2;
  return Array.from({ length: Math.ceil(range_max_m / step) - 1 }, (_, i) => (i + 1) * step);
}

/** Outline of the field of view, with circles, the boresight and the pole. */
function radarLines(radar) {
  const out = [];
  const look = { colour: MARK.c6 };
  const [x, y, height] = radar.position_m;
  const rim = groundArc(radar, radar.range_max_m);
  addLines(out, rim, look);
  for (const range of circleRanges(radar.range_max_m)) {
    addLines(out, groundArc(radar, range), { ...look, opacity: 0.35 });
  }
  for (const end of [rim[0], rim.at(-1)]) if (end) addLine(out, radar.position_m, end, look);
  addLine(out, [x, y, 0], [x, y, height], look);
  addLine(out, radar.position_m, boresightEnd(radar), { ...look, opacity: 0.6 });
  return out;
}

function radarDot(radar) {
  const out = [];
  addMark(out, radar.position_m, { colour: MARK.c6, size: 9 });
  return out;
}

/** Where the boresight meets the ground, or the range at which echoes fold. */
function boresightEnd(radar) {
  const level = Math.cos(radar.boresight_el_rad);
  const ahead = [
    Math.sin(radar.boresight_az_rad) * level,
    Math.cos(radar.boresight_az_rad) * level,
    Math.sin(radar.boresight_el_rad),
  ];
  const down = -radar.position_m[2] / ahead[2];
  return add(radar.position_m, ahead, down > 0 ? Math.min(down, radar.range_max_m) : radar.range_max_m);
}

function boxCorners([low, high]) {
  return Array.from({ length: 8 }, (_, i) =>
    [0, 1, 2].map((axis) => ((i >> axis) & 1 ? high : low)[axis]),
  );
}

/** Corners of a body's box in the world; of a point target its place alone. */
function cornersOf({ mesh, place_m, yaw_rad }, meshes) {
  if (mesh === null) return [place_m];
  return boxCorners(meshes[mesh].box_m).map((corner) => inWorld(corner, place_m, yaw_rad));
}

/** Outlines of the true boxes of a frame's bodies. */
function boxLines(frame, meshes) {
  const out = [];
  frame.bodies.forEach((body, index) => {
    if (body.mesh === null) return;
    const corners = cornersOf(body, meshes);
    for (const [a, b] of EDGES)
      addLine(out, corners[a], corners[b], { colour: classMark(body), body: index });
  });
  return out;
}

function classMark(body) {
  return MARK[body.class] ?? MARK.c6;
}

/** Detected points, larger where they stand higher above the noise. */
function pointDots({ points }) {
  const out = [];
  points.ranges_m.forEach((range, i) => {
    const size = 4 + Math.min(8, Math.max(0, points.snrs_db[i] - 10) / 5);
    const look = {
      colour: MARK.found,
      body: points.targets[i] - 1,
      range,
      velocity: points.velocities_mps[i],
      size,
    };
    addMark(out, points.places_m.slice(3 * i, 3 * i + 3), look);
  });
  return out;
}

function objectRings({ objects }) {
  const out = [];
  for (const { place_m, target, range_m, velocity_mps } of objects) {
    addMark(out, place_m, {
      colour: MARK.found,
      body: target ?? -1,
      range: range_m,
      velocity: velocity_mps,
      size: 20,
    });
  }
  return out;
}

const BELIEVED = { tentative: 0.5, confirmed: 1, coasting: 0.7 };

/** Rectangles of tracks on the road, and what those that are believed move in a second. */
function trackLines({ tracks }) {
  const out = [];
  for (const track of tracks) {
    const look = { colour: MARK.c4, opacity: BELIEVED[track.state] };
    const corner = ([along, across]) => {
      const place = [(along * track.length_m) / 2, (across * track.width_m) / 2, 0.1];
      return inWorld(place, [...track.centre_m, 0], track.heading_rad);
    };
    addLines(
      out,
      [
        [1, 1],
        [1, -1],
        [-1, -1],
        [-1, 1],
        [1, 1],
      ].map(corner),
      look,
    );
    if (track.state === "tentative") continue;
    const from = [...track.place_m, 0.1];
    addLine(out, from, add(from, [...track.velocity_mps, 0]), look);
  }
  return out;
}
