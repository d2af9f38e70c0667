// Vectors of three and matrices of four by four, column by column, as WebGL takes them.

const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const add = (a, b, share = 1) => [a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const unit = (a) => a.map((value) => value / Math.hypot(...a));

function product(a, b) {
  const out = new Float32Array(16);
  for (let column = 0; column < 4; column++) {
    for (let row = 0; row < 4; row++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += a[4 * k + row] * b[4 * column + k];
      out[4 * column + row] = sum;
    }
  }
  return out;
}

/** Perspective with the field of view across the height. */
function perspective(heightRad, aspect, near, far) {
  const scale = 1 / Math.tan(heightRad / 2);
  const depth = 1 / (near - far);
  return [
    scale / aspect,
    0,
    0,
    0,
    0,
    scale,
    0,
    0,
    0,
    0,
    (near + far) * depth,
    -1,
    0,
    0,
    2 * near * far * depth,
    0,
  ];
}

/** Eye coordinates from world: right, up and back of an eye. */
function eyeFromWorld(eye, right, up, back) {
  const row = (axis) => -dot(axis, eye);
  return [
    right[0],
    up[0],
    back[0],
    0,
    right[1],
    up[1],
    back[1],
    0,
    right[2],
    up[2],
    back[2],
    0,
    row(right),
    row(up),
    row(back),
    1,
  ];
}

/** World coordinates from those of a body that stands upright. */
function worldFromBody([x, y, z], yawRad) {
  const [c, s] = [Math.cos(yawRad), Math.sin(yawRad)];
  return [c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, x, y, z, 1];
}

const UNTURNED = worldFromBody([0, 0, 0], 0);

/** A world place in body coordinates; of a direction with a body in the origin. */
function inBody([x, y, z], place, yawRad) {
  const [dx, dy] = [x - place[0], y - place[1]];
  const [c, s] = [Math.cos(yawRad), Math.sin(yawRad)];
  return [c * dx + s * dy, c * dy - s * dx, z - place[2]];
}

/** A place of a body in world coordinates. */
function inWorld([x, y, z], place, yawRad) {
  const [c, s] = [Math.cos(yawRad), Math.sin(yawRad)];
  return [place[0] + c * x - s * y, place[1] + s * x + c * y, place[2] + z];
}
