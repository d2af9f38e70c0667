// Opens a report in Chromium and looks at what a reader sees: pixels, clicks, sliders, a telephone, light and
// dark, paper.
//
//   node check.mjs CHROMIUM REPORT.html [VIEW.html [STUDY.html [FOLDER for pictures]]]
//
// The report is of several frames with paths of several bounces, the view of an `rcs` table over azimuth, the
// study of several designs and situations; a page that is not named, or by an empty word, is not looked at.
// The last line is one of `cargo test`.

import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { bodyIsViewed } from "./body.mjs";
import { launch } from "./chromium.mjs";
import {
  cursorIsDrawn,
  cursorIsShared,
  cutsMoveTheCursor,
  hoverMovesTheCursor,
  maskIsOutlined,
  pathsFade,
} from "./cursor.mjs";
import { telephone, withoutView } from "./fallback.mjs";
import { openView } from "./looks.mjs";
import { takePictures } from "./pictures.mjs";
import {
  heightsAreTold,
  layersAreToggled,
  namesAreFree,
  pictureIsDrawn,
  pointTargetIsChosen,
  slidersMove,
  speeds,
  vehicleIsChosen,
} from "./report.mjs";
import { studyIsViewed } from "./study.mjs";
import { concluded, holds } from "./tally.mjs";
import { colourIsReadable } from "./themes.mjs";

const [program, report, body, study, folder] = process.argv.slice(2);
if (!report) {
  console.error("node check.mjs CHROMIUM REPORT.html [VIEW.html [STUDY.html [FOLDER for pictures]]]");
  process.exit(2);
}

async function reportIsViewed(page, url) {
  await openView(page, url);
  holds("starts its view", await page.value("typeof waysideViewer === 'object'"));
  await pictureIsDrawn(page);
  await namesAreFree(page, "a page");
  await heightsAreTold(page);
  await slidersMove(page);
  await layersAreToggled(page);
  await vehicleIsChosen(page);
  await pointTargetIsChosen(page);
  await maskIsOutlined(page);
  await cursorIsShared(page);
  await cursorIsDrawn(page);
  await hoverMovesTheCursor(page);
  await pathsFade(page);
  await cutsMoveTheCursor(page);
  await speeds(page);
  await openView(page, url, [400, 800]);
  await namesAreFree(page, "a telephone");
}

const { page, close } = await launch(program);
try {
  for (const [name, file, isViewed] of [
    ["report", report, reportIsViewed],
    ["body", body, bodyIsViewed],
    ["study", study, studyIsViewed],
  ]) {
    if (!file) continue;
    const { href } = pathToFileURL(resolve(file));
    await isViewed(page, href);
    await colourIsReadable(page, name, href);
    await telephone(page, name, href);
    await withoutView(page, name, href);
    if (folder) await takePictures(page, name, href, folder);
  }
} finally {
  await close();
}
process.exitCode = concluded();
