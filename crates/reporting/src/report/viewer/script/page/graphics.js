// WebGL 2: the two programs that draw everything, and the buffers that they draw.

const SURFACE_VERTEX = `#version 300 es
uniform mat4 clip_from_world, world_from_body;
layout(location = 0) in vec3 place;
out vec3 world;
void main() {
  vec4 at = world_from_body * vec4(place, 1.0);
  world = at.xyz;
  gl_Position = clip_from_world * at;
}`;

// Flat shading: the facet's normal is that of the triangle on the screen.
const SURFACE_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 colour;
uniform float shaded;
in vec3 world;
out vec4 pixel;
void main() {
  vec3 normal = normalize(cross(dFdx(world), dFdy(world)));
  float light = 0.62 + 0.3 * abs(dot(normal, normalize(vec3(0.4, -0.5, 0.75)))) + 0.08 * normal.z;
  pixel = vec4(colour.rgb * mix(1.0, light, shaded), colour.a);
}`;

// A mark is a vertex of a line or a dot. kind: index of its colour, its body; cell: range and velocity.
// What lies outside of the cursor's cell or is not of the chosen body becomes faint; ranges and velocities
// that the map shows alike, a whole repeat apart, lie in one cell.
const MARK_VERTEX = `#version 300 es
uniform mat4 clip_from_world;
uniform vec4 colours[13];
uniform vec4 cursor;
uniform vec2 repeats;
uniform float chosen, faint, opacity, pixels;
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 kind;
layout(location = 2) in vec2 size;
out vec4 colour;
void main() {
  gl_Position = clip_from_world * vec4(place, 1.0);
  gl_PointSize = size.x * pixels;
  colour = colours[int(kind.x)];
  vec2 apart = kind.zw - cursor.xy;
  vec2 turns = floor(apart / max(repeats, vec2(1e-9)) + 0.5);
  apart -= repeats * turns;
  bool in_cell = all(lessThanEqual(abs(apart), cursor.zw));
  bool is_chosen = chosen < 0.0 || kind.y == chosen;
  colour.a *= opacity * size.y * (is_chosen && (cursor.z <= 0.0 || in_cell) ? 1.0 : faint);
}`;

const MARK_FRAGMENT = `#version 300 es
precision highp float;
uniform int form;
in vec4 colour;
out vec4 pixel;
void main() {
  float radius = 2.0 * length(gl_PointCoord - 0.5);
  if (form > 0 && radius > 1.0) discard;
  if (form == 2 && radius < 0.68) discard;
  pixel = colour;
}`;

/** Forms of marks: lines, filled dots, rings. */
const FORM = { line: 0, dot: 1, ring: 2 };

function makeGraphics(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: !isDrawnByProcessor(), alpha: false });
  if (!gl) return null;
  gl.enable(gl.BLEND);
  gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  // Surfaces lie a little deeper than the lines on them.
  gl.enable(gl.POLYGON_OFFSET_FILL);
  gl.polygonOffset(1, 4);
  gl.depthFunc(gl.LEQUAL);
  const surface = program(gl, SURFACE_VERTEX, SURFACE_FRAGMENT);
  return { gl, surface, mark: program(gl, MARK_VERTEX, MARK_FRAGMENT) };
}

/** Whether there is no graphics card: smooth lines then cost more than half of the time. */
function isDrawnByProcessor() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const name = gl ? String(gl.getParameter(gl.RENDERER)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  gl.attachShader(made, shader(gl, gl.VERTEX_SHADER, vertex));
  gl.attachShader(made, shader(gl, gl.FRAGMENT_SHADER, fragment));
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); i++) {
    const name = gl.getActiveUniform(made, i).name;
    uniforms[name.replace("[0]", "")] = gl.getUniformLocation(made, name);
  }
  return { made, uniforms };
}

function shader(gl, type, source) {
  const made = gl.createShader(type);
  gl.shaderSource(made, source);
  gl.compileShader(made);
  if (!gl.getShaderParameter(made, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(made));
  return made;
}

/** A surface of triangles on the card. */
function surfaceBuffer({ gl }, corners, triangles) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  attribute(gl, 0, 3, Float32Array.from(corners), 12, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(triangles), gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  return { array, count: triangles.length };
}

const FLOATS_OF_A_MARK = 9;

/** Marks on the card: nine numbers each, x y z, colour, body, range, velocity, size, opacity. */
function markBuffer({ gl }, numbers) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  const stride = 4 * FLOATS_OF_A_MARK;
  const buffer = attribute(gl, 0, 3, Float32Array.from(numbers), stride, 0);
  attribute(gl, 1, 4, null, stride, 12);
  attribute(gl, 2, 2, null, stride, 28);
  gl.bindVertexArray(null);
  return { array, buffer, count: numbers.length / FLOATS_OF_A_MARK };
}

function attribute(gl, location, size, numbers, stride, offset) {
  let buffer = null;
  if (numbers) {
    buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
  }
  gl.enableVertexAttribArray(location);
  gl.vertexAttribPointer(location, size, gl.FLOAT, false, stride, offset);
  return buffer;
}

function forget({ gl }, { array, buffer }) {
  gl.deleteVertexArray(array);
  gl.deleteBuffer(buffer);
}

/** Draws a surface; look: clip, place of the body, colour, shaded. */
function drawSurface({ gl, surface }, buffer, look) {
  gl.useProgram(surface.made);
  gl.uniformMatrix4fv(surface.uniforms.clip_from_world, false, look.clip);
  gl.uniformMatrix4fv(surface.uniforms.world_from_body, false, look.body ?? UNTURNED);
  gl.uniform4fv(surface.uniforms.colour, look.colour);
  gl.uniform1f(surface.uniforms.shaded, look.shaded ?? 0);
  gl.bindVertexArray(buffer.array);
  gl.drawElements(gl.TRIANGLES, buffer.count, gl.UNSIGNED_INT, 0);
}

/** Draws the first `count` marks of a buffer as lines, dots or rings. */
function drawMarks({ gl, mark }, buffer, look) {
  const { uniforms } = mark;
  gl.useProgram(mark.made);
  gl.uniformMatrix4fv(uniforms.clip_from_world, false, look.clip);
  gl.uniform4fv(uniforms.colours, look.colours);
  gl.uniform4fv(uniforms.cursor, look.cursor?.cell ?? [0, 0, 0, 0]);
  gl.uniform2fv(uniforms.repeats, look.cursor?.repeats ?? [0, 0]);
  gl.uniform1f(uniforms.chosen, look.chosen ?? -1);
  gl.uniform1f(uniforms.faint, look.faint ?? 0.08);
  gl.uniform1f(uniforms.opacity, look.opacity ?? 1);
  gl.uniform1f(uniforms.pixels, look.pixels);
  gl.uniform1i(uniforms.form, look.form);
  gl.bindVertexArray(buffer.array);
  gl.drawArrays(look.form === FORM.line ? gl.LINES : gl.POINTS, 0, look.count ?? buffer.count);
}

/** As many pixels as the screen has there; gives pixels of the screen per pixel of the page. */
function resize(canvas) {
  const pixels = Math.min(2, globalThis.devicePixelRatio || 1);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((size) =>
    Math.max(1, Math.round(size * pixels)),
  );
  if (canvas.width !== width || canvas.height !== height)
    [canvas.width, canvas.height] = [width, height];
  return pixels;
}
