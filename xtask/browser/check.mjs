// Opens a report in Chromium and looks at what a reader sees: pixels, clicks, sliders, a telephone, paper.
//
//   node check.mjs CHROMIUM REPORT.html [VIEW.html [STUDY.html [FOLDER for pictures]]]
//
// The report is of several frames with paths of several bounces, the view of an `rcs` table over azimuth, the
// study of several designs and situations; a page that is not named is not looked at. The last line is one of
// `cargo test`.

import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { launch, pause } from "./chromium.mjs";

const [program, report, body, study, folder] = process.argv.slice(2);
if (!report) {
  console.error("node check.mjs CHROMIUM REPORT.html [VIEW.html [STUDY.html [FOLDER for pictures]]]");
  process.exit(2);
}
const [url, urlOfBody, urlOfStudy] = [report, body, study].map(
  (file) => file && pathToFileURL(resolve(file)).href,
);
const tally = { passed: 0, failed: 0 };

function holds(claim, isTrue, seen) {
  tally[isTrue ? "passed" : "failed"]++;
  console.log(`report ${claim} ... ${isTrue ? "ok" : `FAILED: ${JSON.stringify(seen)}`}`);
}

/** Pixels of the picture with the layers that are named, read in the page. */
const PIXELS = `((layers) => {
  const { view } = waysideViewer;
  Object.keys(view.state.layers).forEach((name) => (view.state.layers[name] = layers.includes(name)));
  waysideViewer.draw();
  const { gl } = view.space.graphics;
  const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return pixels;
})`;

/** Number of different colours in the picture. */
const COLOURS = `(() => {
  const pixels = ${PIXELS}(["bodies", "beam"]);
  const colours = new Set();
  for (let i = 0; i < pixels.length; i += 4) colours.add(pixels.slice(i, i + 3).join());
  return colours.size;
})()`;

// A path is drawn over what lies behind it: its pixels lie on the way from that colour to its order's.
const ORDERS = `(() => {
  const { view } = waysideViewer;
  const { frame, shown, colours } = view.state;
  const orders = [...new Set(frame.paths.orders.slice(0, shown))];
  const [behind, over] = [${PIXELS}([]), ${PIXELS}(["paths"])];
  const seen = orders.map((order) => {
    const own = colours.marks.slice(4 * order, 4 * order + 3).map((value) => 255 * value);
    let count = 0;
    for (let i = 0; i < over.length; i += 4) {
      const moved = [0, 1, 2].map((c) => over[i + c] - behind[i + c]);
      const whole = [0, 1, 2].map((c) => own[c] - behind[i + c]);
      const [a, b] = [Math.hypot(...moved), Math.hypot(...whole)];
      const along = moved[0] * whole[0] + moved[1] * whole[1] + moved[2] * whole[2];
      if (a > 24 && along > 0.985 * a * b) count++;
    }
    return { order, count };
  });
  Object.keys(view.state.layers).forEach((name) => (view.state.layers[name] = name !== "boxes"));
  return seen;
})()`;

const slide = (name, value) => `(() => {
  const slider = document.getElementById("viewer-${name}");
  slider.value = ${value};
  slider.dispatchEvent(new Event("input"));
  return document.getElementById("viewer-${name}-told").textContent;
})()`;

const TEXT = (name) => `document.getElementById("viewer-${name}").textContent`;
const RECT = (name) => `(() => {
  const element = document.getElementById("viewer-${name}");
  element.scrollIntoView({ block: "center" });
  const { x, y, width, height } = element.getBoundingClientRect();
  return { x, y, width, height };
})()`;

async function pictureIsDrawn(page) {
  const colours = await page.value(COLOURS);
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

async function heightsAreTold(page) {
  const assumed = await page.value("waysideViewer.view.state.frame.assumed_height_m");
  const words = await page.value(TEXT("told"));
  holds("tells whether heights are assumed", (assumed !== null) === words.includes("assumed height"), words);
}

async function slidersMove(page) {
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

async function vehicleIsChosen(page) {
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
  }
}

async function cursorIsShared(page) {
  const box = await page.value(RECT("map"));
  const target = await page.value("waysideViewer.view.state.frame.objects[0]");
  const at = await page.value(`waysideViewer.pixelOnMap(${target.range_m}, ${target.velocity_mps})`);
  await page.mouse("mouseMoved", box.x + at[0], box.y + at[1]);
  await pause(200);
  const text = await page.value(TEXT("readout"));
  const cursor = await page.value("waysideViewer.view.state.cursor");
  const isNear = cursor && Math.abs(cursor.range - target.range_m) < 1;
  holds("reads range and velocity under the pointer", isNear, [cursor, target]);
  holds("tells level, verdict and whose echo", /dB over the noise, .*echo of /.test(text), text);
}

async function pointTargetIsChosen(page) {
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
    holds(claim, isChosen && text.includes(id), text);
  }
}

/** Each cut sets its own part of the cursor, and a click holds it. */
async function cutsMoveTheCursor(page) {
  const cursor = "waysideViewer.view.state.cursor";
  for (const [name, moved, kept] of [
    ["range", "range", "velocity"],
    ["doppler", "velocity", "range"],
  ]) {
    const box = await page.value(RECT(name));
    const at = (share) => [box.x + share * box.width, box.y + share * box.height];
    const seen = [await page.value(cursor)];
    for (const share of [0.6, 0.4]) {
      await page.mouse("mouseMoved", ...at(share));
      await pause(100);
      seen.push(await page.value(cursor));
    }
    const isMoved = new Set(seen.slice(1).map((of) => of[moved])).size === 2;
    const isKept = seen.every((of) => of[kept] === seen[0][kept]);
    holds(`moves the cursor by the ${name} cut`, isMoved && isKept, seen);
    await page.click(...at(0.4));
    await page.mouse("mouseMoved", ...at(0.6));
    await pause(100);
    const held = await page.value(cursor);
    holds(`holds the cursor by a click on the ${name} cut`, held[moved] === seen[2][moved], [seen, held]);
    await page.click(...at(0.6));
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
async function speeds(page) {
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

async function telephone(page) {
  await page.size(400, 800);
  await pause(300);
  const width = await page.value("document.documentElement.scrollWidth");
  holds("fits a telephone of 400 pixels", width <= 400, width);
}

async function withoutView(page) {
  await page.theme("light", "print");
  const isGone = "getComputedStyle(document.getElementById('viewer')).display === 'none'";
  const drawings =
    "[...document.querySelectorAll('figure svg')].some((svg) => svg.getBoundingClientRect().height > 100)";
  holds("is printed with its drawings alone", await page.value(`${isGone} && ${drawings}`));
  await page.theme("light");
  await page.send("Emulation.setScriptExecutionDisabled", { value: true });
  await page.open("about:blank");
  await page.open(url);
  holds("shows its drawings where no script runs", await page.value(`${isGone} && ${drawings}`));
}

/** Number of different colours in the picture of a body. */
const COLOURS_OF_BODY = (layers) => COLOURS.replace('["bodies", "beam"]', JSON.stringify(layers));

async function bodyIsViewed(page) {
  await page.open(urlOfBody);
  holds("starts the view of a body", await page.value("typeof waysideViewer === 'object'"));
  await page.value(slide("level", -40));
  const [none, facets, rays] = [
    await page.value(COLOURS_OF_BODY([])),
    await page.value(COLOURS_OF_BODY(["body"])),
    await page.value(COLOURS_OF_BODY(["rays"])),
  ];
  holds("draws facets and sequences", none === 1 && facets > 30 && rays > 10, [none, facets, rays]);
  const [few, many] = [await page.value(slide("level", -3)), await page.value(slide("level", -40))];
  const count = (told) => Number(/strongest: ([\d,]+) /.exec(told)[1].replaceAll(",", ""));
  holds("shows more sequences farther down", count(few) < count(many), [few, many]);
  const strongest = "waysideViewer.view.page.levels.indexOf(Math.max(...waysideViewer.view.page.levels))";
  await page.value(`waysideViewer.choose(${strongest})`);
  const rows = await page.value("document.querySelectorAll('#viewer-panel td').length");
  holds("lists the sequences of a facet", rows >= 4, rows);
  const box = await page.value(RECT("space"));
  await page.click(box.x + box.width / 2, box.y + box.height / 2);
  await pause(100);
  const chosen = await page.value("waysideViewer.view.state.chosen");
  holds("tells which facet is clicked", Number.isInteger(chosen), chosen);
  if (folder) await takePictures(page, "body", "side");
  await telephone(page);
  await page.size(1400, 900);
}

/** Sets a control of the view and tells it. */
const set = (name, property, value) => `(() => {
  const control = document.getElementById("viewer-${name}");
  control.${property} = ${JSON.stringify(value)};
  control.dispatchEvent(new Event("input"));
})()`;

async function studyIsViewed(page) {
  await page.open(urlOfStudy);
  holds("starts the view of a study", await page.value("typeof waysideViewer === 'object'"));
  const [none, bodies, dots] = [
    await page.value(COLOURS_OF_BODY([])),
    await page.value(COLOURS_OF_BODY(["bodies"])),
    await page.value(COLOURS_OF_BODY(["designs"])),
  ];
  holds("draws vehicles and designs", bodies > none + 20 && dots > none, [none, bodies, dots]);
  await page.value("Object.keys(waysideViewer.view.state.layers).forEach((name) => {" +
    " waysideViewer.view.state.layers[name] = true; }), waysideViewer.draw()");
  const count = await page.value("waysideViewer.view.page.designs.length");
  for (const [canvas, pixelOf] of [["space", "pixelOf"], ["chart", "pixelOnChart"]]) {
    const box = await page.value(RECT(canvas));
    const before = await page.value("waysideViewer.view.state.chosen");
    const other = count - 1 - before;
    const [x, y] = await page.value(`waysideViewer.${pixelOf}(${other})`);
    await page.click(box.x + x, box.y + y);
    await pause(100);
    const chosen = await page.value("waysideViewer.view.state.chosen");
    const text = await page.value(TEXT("panel"));
    const isTold = text.includes(`Design ${chosen}`) && text.includes("coverage");
    const claim = `tells of the design whose dot in the ${canvas} is clicked`;
    holds(claim, chosen === other && isTold, [other, chosen]);
  }
  const place = "waysideViewer.view.page.situations[waysideViewer.view.state.situation].bodies[1].place_m[0]";
  const first = await page.value(place);
  await page.value(set("situation", "value", 1));
  const [second, words] = [await page.value(place), await page.value(TEXT("situation-told"))];
  const isOther = first !== second && words.includes("lane 3");
  holds("goes from situation to situation", isOther, [first, second, words]);
  const mean = await page.value(TEXT("scale-told"));
  await page.value(set("alone", "checked", true));
  const alone = await page.value(TEXT("scale-told"));
  holds("colours one situation alone", mean.includes("mean over") && alone.includes("alone"), [mean, alone]);
  await page.value(set("alone", "checked", false));
  await page.value(set("metric", "value", "0"));
  if (folder) await takePictures(page, "study", "around");
  await telephone(page);
  await page.size(1400, 900);
}

const PLACE_OF_VIEW = `(() => {
  const { y, height } = document.getElementById("viewer").getBoundingClientRect();
  return [y + scrollY, height];
})()`;

async function takePictures(page, name, place) {
  if (name !== "study") await page.value(slide("level", -30));
  await page.value(`document.querySelector("#viewer [data-place=${place}]").click()`);
  for (const [width, height] of [
    [1400, 900],
    [400, 800],
  ]) {
    for (const scheme of ["light", "dark"]) {
      await page.size(width, height);
      await page.theme(scheme);
      await pause(800);
      const [top, tall] = await page.value(PLACE_OF_VIEW);
      const picture = await page.picture({
        x: 0,
        y: Math.max(0, top - 20),
        width,
        height: tall + 40,
        scale: 1,
      });
      writeFileSync(join(folder, `${name}-${width}-${scheme}.png`), picture);
    }
  }
  await page.theme("light");
}

const { page, close } = await launch(program);
try {
  await page.size(1400, 900);
  await page.theme("light");
  await page.open(url);
  holds("starts its view", await page.value("typeof waysideViewer === 'object'"));
  await pictureIsDrawn(page);
  await heightsAreTold(page);
  await slidersMove(page);
  await vehicleIsChosen(page);
  await pointTargetIsChosen(page);
  await cursorIsShared(page);
  await cutsMoveTheCursor(page);
  await speeds(page);
  if (folder) await takePictures(page, "report", "around");
  await telephone(page);
  if (urlOfBody) await bodyIsViewed(page);
  if (urlOfStudy) await studyIsViewed(page);
  await page.open(url);
  await withoutView(page);
} finally {
  await close();
}
console.log(
  `test result: ${tally.failed ? "FAILED" : "ok"}. ${tally.passed} passed; ${tally.failed} failed`,
);
process.exitCode = tally.failed ? 1 : 0;
