// The view of a run: its picture, sliders, layers, and what a click on a vehicle tells.

import { pause } from "./chromium.mjs";
import { COLOURS, PIXELS, RECT, TEXT, settled, slide } from "./looks.mjs";
import { holds } from "./tally.mjs";

// A path is drawn over what lies behind it: its pixels lie on the way from that colour to its order's.
const ORDERS = `(() => {
  const { frame, shown, colours } = waysideViewer.view.state;
  const orders = [...new Set(frame.paths.orders.slice(0, shown))];
  const [behind, over] = [${PIXELS}([]), ${PIXELS}(["paths"])];
  look.layers();
  return orders.map((order) => {
    const own = colours.marks.slice(4 * order, 4 * order + 3).map((value) => 255 * value);
    return { order, count: look.moved(behind, over, [own]).towards };
  });
})()`;

export async function pictureIsDrawn(page) {
  const colours = await page.value(COLOURS(["bodies", "beam"]));
  holds("draws vehicles, road and field of view", colours > 30, colours);
  await page.value(slide("level", -60));
  const orders = await page.value(ORDERS);
  holds("has paths of several bounce orders", orders.length > 1, orders);
  holds(
    "draws each bounce order in its colour",
    orders.every(({ count }) => count > 0),
    orders,
  );
}

// Places of the names that are shown, and of objects, in pixels of the picture.
const NAMES = `(() => {
  const { x, y } = waysideViewer.view.space.canvas.getBoundingClientRect();
  const names = [...document.querySelectorAll("#viewer-names > *")].filter((name) => !name.hidden);
  const box = (name) => {
    const { left, top, right, bottom } = name.getBoundingClientRect();
    const at = [left - x, top - y, right - x, bottom - y];
    return { words: name.textContent, isButton: name.localName === "button", at };
  };
  const { objects } = waysideViewer.view.state.frame;
  const pixels = objects.map(({ place_m }) => waysideViewer.pixelOfPlace(place_m));
  return { names: names.map(box), pixels };
})()`;

/** Names of all bodies are shown, no two names overlap, and those of lanes and of the radar cover no object. */
export async function namesAreFree(page, where) {
  await page.value("look.layers()");
  const { names, pixels } = await page.value(NAMES);
  const overlap = (a, b) => a[0] < b[2] - 1 && b[0] < a[2] - 1 && a[1] < b[3] - 1 && b[1] < a[3] - 1;
  const isCovered = ([x, y]) =>
    names.some(({ isButton, at }) => !isButton && overlap(at, [x - 2, y - 2, x + 2, y + 2]));
  const areApart = names.every(({ at }, i) => names.slice(0, i).every((other) => !overlap(at, other.at)));
  const bodies = await page.value("waysideViewer.view.state.frame.bodies.length");
  const isEach = names.filter(({ isButton }) => isButton).length === bodies;
  holds(`writes the name of every body on ${where}, and none over another`, isEach && areApart, names);
  const areFree = pixels.length > 0 && !pixels.some(isCovered);
  holds(`covers no object on ${where} by the name of a lane`, areFree, [names, pixels]);
}

export async function heightsAreTold(page) {
  const assumed = await page.value("waysideViewer.view.state.frame.assumed_height_m");
  const words = await page.value(TEXT("told"));
  holds("tells whether heights are assumed", (assumed !== null) === words.includes("assumed height"), words);
}

export async function slidersMove(page) {
  const [few, many] = [await page.value(slide("level", -3)), await page.value(slide("level", -60))];
  const count = (told) => Number(/strongest: ([\d,]+) of/.exec(told)[1].replaceAll(",", ""));
  holds("shows more paths farther down", count(few) < count(many), [few, many]);
  holds("tells the power that is left out", few.includes("of the power left out"), few);
  const one = await page.value(slide("level", 0));
  holds("tells shares without powers of ten", !one.includes("e+"), one);
  await page.value(slide("level", -60));
  if ((await page.value("waysideViewer.view.page.frames.length")) < 2) return;
  const frames = [await page.value(slide("frame", 1)), await page.value(slide("frame", 0))];
  holds("goes from frame to frame", frames[0] !== frames[1] && frames[1].startsWith(" 0 at"), frames);
}

// Colours of the marks of a layer: of true boxes those of the bodies' classes.
const COLOURS_OF_LAYERS = {
  points: `["found"]`,
  objects: `["found"]`,
  tracks: `["c4"]`,
  boxes: `waysideViewer.view.state.frame.bodies.map((body) => body.class ?? "c6")`,
};

const TICK = (name) => `(() => {
  const box = document.querySelector('#viewer [data-layer="${name}"]');
  box.scrollIntoView({ block: "center" });
  const { x, y, width, height } = box.getBoundingClientRect();
  return [x + width / 2, y + height / 2];
})()`;

async function tick(page, name) {
  await page.click(...(await page.value(TICK(name))));
  await settled(page);
}

/** A click on the box of a layer draws its marks in their colours, another one takes them away. */
export async function layersAreToggled(page) {
  await page.value("waysideViewer.choose(null)");
  const ticked = await page.value(
    "[...document.querySelectorAll('#viewer [data-layer]:checked')].map((box) => box.dataset.layer)",
  );
  for (const name of ticked) await tick(page, name);
  await page.value("globalThis.bare = look.space(), null");
  for (const [name, marks] of Object.entries(COLOURS_OF_LAYERS)) {
    await tick(page, name);
    const drawn = await page.value(`look.moved(bare, look.space(), ${marks}.map(look.mark))`);
    await tick(page, name);
    const left = await page.value(`look.moved(bare, look.space(), []).all`);
    const isToggled = drawn.towards > 20 && left === 0;
    holds(`draws ${name} in their colours, if they are asked for`, isToggled, [drawn, left]);
  }
  for (const name of ticked) await tick(page, name);
}

export async function vehicleIsChosen(page) {
  const box = await page.value(RECT("space"));
  for (const index of [0, 1]) {
    const [x, y] = await page.value(`waysideViewer.pixelOf(${index})`);
    await page.click(box.x + x, box.y + y);
    await pause(100);
    const id = await page.value(`waysideViewer.view.state.frame.bodies[${index}].id`);
    const text = await page.value(TEXT("panel"));
    const parts = [id, "Class", "probability", "Shown paths", "Error budget", "total"];
    holds(
      `tells of ${id} when it is clicked`,
      parts.every((part) => text.includes(part)),
      text,
    );
    await ownErrorIsTold(page, id);
  }
}

/** The error of the chosen vehicle's own echo, beside that of the whole frame. */
async function ownErrorIsTold(page, id) {
  const targets = await page.value("waysideViewer.view.state.frame.targets");
  const { error } = targets.find((target) => target.id === id);
  const told = await page.value(
    "[...document.querySelectorAll('#viewer-panel table')].map((table) => table.innerText)",
  );
  const words = told.find((table) => table.startsWith("This vehicle's own error")) ?? "";
  const rows = [
    ["echo, dB", error?.echo_db, 1],
    ["σ of range, m", error?.range_m, 3],
    ["σ of velocity, m/s", error?.radial_velocity_mps, 4],
    ["σ across, m", error?.across_m, 3],
  ];
  const isTold = ([name, value, digits]) =>
    words.includes(`${name}\t${value?.toFixed(digits).replace("-", "−")}`);
  holds(`tells the error of the own echo of ${id}`, rows.every(isTold), [error, told]);
}

export async function pointTargetIsChosen(page) {
  const index = await page.value("waysideViewer.view.state.frame.bodies.findIndex((b) => b.mesh === null)");
  if (index < 0) return;
  for (const aside of [0, 7]) {
    await page.value("waysideViewer.choose(null)");
    const box = await page.value(RECT("space"));
    const [x, y] = await page.value(`waysideViewer.pixelOf(${index})`);
    await page.click(box.x + x + aside, box.y + y);
    await pause(100);
    const id = await page.value(`waysideViewer.view.state.frame.bodies[${index}].id`);
    const text = await page.value(TEXT("panel"));
    const isChosen = (await page.value("waysideViewer.view.state.chosen")) === index;
    const claim = `tells of ${id}, a point, when ${aside} pixels beside it are clicked`;
    holds(claim, isChosen && text.includes(id) && text.includes("a point target's echo is exact"), text);
  }
}

/** Paths of which the view has to be quick enough to be turned. */
const MANY = 50_000;

// Each path so many times, a hand's breadth beside the one before, weakest last as before; returns those that
// were there.
const TILED = (times) => `(() => {
  const { shown } = waysideViewer.view.page.frames[0];
  const own = shown.paths;
  const again = (list) => Array.from(list).flatMap((value) => Array(${times}).fill(value));
  const { corners, orders, targets, ranges_m, velocities_mps, levels_dbw } = own;
  const many = { corners, orders, targets, ranges_m, velocities_mps, levels_dbw };
  Object.keys(many).forEach((name) => (many[name] = again(many[name])));
  let first = 0;
  many.places_m = Array.from(corners).flatMap((count) => {
    const places = Array.from(own.places_m.slice(3 * first, 3 * (first += count)));
    return Array.from({ length: ${times} }, (_, copy) => places.map((place) => place + 0.1 * copy)).flat();
  });
  shown.paths = { ...own, ...many, all: ${times} * own.all };
  globalThis.ownPaths = own;
})()`;

/** Pictures per second with all paths, and with many. */
export async function speeds(page) {
  await speed(page, 10);
  const shown = await page.value("waysideViewer.view.state.shown");
  const times = Math.ceil(MANY / Math.max(1, shown));
  await page.value(TILED(times));
  await page.value(slide("frame", 0));
  await speed(page, 3);
  const many = await page.value("waysideViewer.view.state.shown");
  holds("draws fifty thousand paths", many >= MANY, many);
  await page.value("waysideViewer.view.page.frames[0].shown.paths = ownPaths, null");
  await page.value(slide("frame", 0));
}

async function speed(page, pictures) {
  await page.value(slide("level", -80));
  const seconds = await page.value(`(() => {
    const { gl } = waysideViewer.view.space.graphics;
    const wait = () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    waysideViewer.draw();
    wait();
    const begin = performance.now();
    for (let i = 0; i < ${pictures}; i++) {
      waysideViewer.view.state.camera.azimuth += 0.01;
      waysideViewer.draw();
      wait();
    }
    return (performance.now() - begin) / 1e3 / ${pictures};
  })()`);
  const shown = await page.value("waysideViewer.view.state.shown");
  console.log(`report: ${shown} paths, ${(1 / seconds).toFixed(1)} pictures per second`);
}
