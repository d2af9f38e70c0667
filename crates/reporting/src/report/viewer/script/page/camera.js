// The eye that goes around the scene: it looks at a place from an azimuth, an elevation and a distance.

const HEIGHT_RAD = 0.8;
const STEEPEST_RAD = 1.55;

function makeCamera() {
  return { at: [0, 40, 0], azimuth: -0.5, elevation: 0.5, distance: 70, nearest: 1, farthest: 1500 };
}

/** Directions of the eye: ahead, right and up. */
function eyeAxes({ azimuth, elevation }) {
  const level = Math.cos(elevation);
  const ahead = [Math.sin(azimuth) * level, Math.cos(azimuth) * level, -Math.sin(elevation)];
  const right = [Math.cos(azimuth), -Math.sin(azimuth), 0];
  return { ahead, right, up: cross(right, ahead) };
}

function eyePlace(camera) {
  return add(camera.at, eyeAxes(camera).ahead, -camera.distance);
}

/** Clip coordinates from world, for a picture of this width over height. */
function clipFromWorld(camera, aspect) {
  const { ahead, right, up } = eyeAxes(camera);
  const back = ahead.map((value) => -value);
  const far = Math.max(3000, 4 * camera.distance);
  const lens = perspective(HEIGHT_RAD, aspect, Math.max(0.2, 0.01 * camera.distance), far);
  return product(lens, eyeFromWorld(eyePlace(camera), right, up, back));
}

/** The ray through a place of the picture, −1 to 1 to the right and up. */
function rayThrough(camera, aspect, [x, y]) {
  const { ahead, right, up } = eyeAxes(camera);
  const half = Math.tan(HEIGHT_RAD / 2);
  const direction = unit(add(add(ahead, right, x * half * aspect), up, y * half));
  return { from: eyePlace(camera), direction };
}

function turn(camera, azimuth, elevation) {
  camera.azimuth += azimuth;
  camera.elevation = Math.min(STEEPEST_RAD, Math.max(-0.1, camera.elevation + elevation));
}

/** Moves along the ground by shares of the distance. */
function walk(camera, rightwards, forwards) {
  const { right } = eyeAxes(camera);
  const level = [Math.sin(camera.azimuth), Math.cos(camera.azimuth), 0];
  camera.at = add(
    add(camera.at, right, rightwards * camera.distance),
    level,
    forwards * camera.distance,
  );
}

function approach(camera, factor) {
  camera.distance = Math.min(camera.farthest, Math.max(camera.nearest, camera.distance * factor));
}

/** Puts the eye where the radar and these places are seen in a picture of this width over height. */
function standAt(camera, place, radar, places, aspect) {
  const at = [0, 1, 2].map((axis) => middle(places.map((p) => p[axis])));
  const wide = Math.max(...places.map((p) => Math.hypot(...subtract(p, at))));
  camera.farthest = Math.max(camera.farthest, 6 * wide);
  if (place === "radar") {
    Object.assign(camera, fromRadar(radar, Math.hypot(...subtract(at, radar.position_m))));
    return;
  }
  const isAbove = place === "above";
  const azimuth = radar.boresight_az_rad - (isAbove ? 0 : 1);
  Object.assign(camera, { at, azimuth, elevation: isAbove ? STEEPEST_RAD : 0.5 });
  for (let i = 0; i < 4; i++) {
    standBack(camera, aspect, places);
    centre(camera, aspect, places);
  }
  standBack(camera, aspect, places);
}

/** As near as all places are seen from. */
function standBack(camera, aspect, places) {
  camera.distance = 5;
  while (camera.distance < camera.farthest && !places.every((p) => isWellSeen(camera, aspect, p)))
    camera.distance *= 1.05;
}

/** Moves along the ground until the places lie about the picture's middle. */
function centre(camera, aspect, places) {
  const seen = places.map((p) => inPicture(camera, aspect, p));
  const [x, y] = [0, 1].map((axis) => middle(seen.map((at) => at[axis])));
  const half = Math.tan(HEIGHT_RAD / 2);
  walk(camera, x * aspect * half, (y * half) / Math.sin(camera.elevation));
}

/** Where in the picture a place lies, −1 to 1 to the right and up, and its depth before the eye. */
function inPicture(camera, aspect, place) {
  const clip = clipFromWorld(camera, aspect);
  const along = (row) => dot([clip[row], clip[4 + row], clip[8 + row]], place) + clip[12 + row];
  return [along(0) / along(3), along(1) / along(3), along(3)];
}

/** Whether a place lies within the picture, with some room to its edges. */
function isWellSeen(camera, aspect, place) {
  const [x, y, depth] = inPicture(camera, aspect, place);
  return depth > 0 && Math.abs(x) < 0.86 && Math.abs(y) < 0.8;
}

function fromRadar(radar, distance) {
  const [azimuth, elevation] = [radar.boresight_az_rad, 0.14 - radar.boresight_el_rad];
  const view = { azimuth, elevation, distance };
  return { ...view, at: add(add(radar.position_m, [0, 0, 1.5]), eyeAxes(view).ahead, distance) };
}

function middle(values) {
  return values.length ? (Math.min(...values) + Math.max(...values)) / 2 : 0;
}
