// Expressions that are evaluated in the page, and what they see there: pixels, words, places of controls.

import { pause } from "./chromium.mjs";

/** Pixels of the picture with the layers that are named, read in the page. */
export const PIXELS = `((layers) => {
  const { view } = waysideViewer;
  Object.keys(view.state.layers).forEach((name) => (view.state.layers[name] = layers.includes(name)));
  return look.space();
})`;

/** Number of different colours in the picture with the layers that are named. */
export const COLOURS = (layers) => `(() => {
  const pixels = ${PIXELS}(${JSON.stringify(layers)});
  const colours = new Set();
  for (let i = 0; i < pixels.length; i += 4) colours.add(pixels.slice(i, i + 3).join());
  return colours.size;
})()`;

/** Words of a part of the view. */
export const TEXT = (name) => `document.getElementById("viewer-${name}").textContent`;

/** Place of a part of the view in the window, into whose middle it is scrolled. */
export const RECT = (name) => `(() => {
  const element = document.getElementById("viewer-${name}");
  element.scrollIntoView({ block: "center" });
  const { x, y, width, height } = element.getBoundingClientRect();
  return { x, y, width, height };
})()`;

/** Moves a slider and gives what is told beside it. */
export const slide = (name, value) => `(() => {
  const slider = document.getElementById("viewer-${name}");
  slider.value = ${value};
  slider.dispatchEvent(new Event("input"));
  return document.getElementById("viewer-${name}-told").textContent;
})()`;

/** Sets a control of the view and tells it. */
export const set = (name, property, value) => `(() => {
  const control = document.getElementById("viewer-${name}");
  control.${property} = ${JSON.stringify(value)};
  control.dispatchEvent(new Event("input"));
})()`;

// Functions that the page is given. A picture is drawn at the screen's next one: `settled` waits for it.
// Rows of WebGL's pixels begin at the bottom, those of a canvas at the top.
const LOOK = `globalThis.look = {
  settled: () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
  space: () => {
    waysideViewer.draw();
    const { gl } = waysideViewer.view.space.graphics;
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return pixels;
  },
  canvas: (name) => {
    const canvas = document.getElementById("viewer-" + name);
    return canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  },
  redrawn: async (name) => {
    document.querySelector("#viewer [data-layer]").dispatchEvent(new Event("change"));
    await look.settled();
    return look.canvas(name);
  },
  // Whether two pictures differ at a pixel, or beside it.
  differs: (one, other, [x, y], width, within = 1) => {
    for (let row = Math.round(y) - within; row <= Math.round(y) + within; row++)
      for (let column = Math.round(x) - within; column <= Math.round(x) + within; column++)
        for (let c = 0; c < 3; c++) {
          const at = 4 * (row * width + column) + c;
          if (one[at] !== other[at]) return true;
        }
    return false;
  },
  // Number of pixels that move from their colour in one picture towards a colour; all: those that change.
  moved: (behind, over, own) => {
    let [towards, all] = [0, 0];
    for (let i = 0; i < over.length; i += 4) {
      const moved = [0, 1, 2].map((c) => over[i + c] - behind[i + c]);
      const length = Math.hypot(...moved);
      if (length <= 24) continue;
      all++;
      const isTowards = own.some((colour) => {
        const whole = [0, 1, 2].map((c) => colour[c] - behind[i + c]);
        const along = moved[0] * whole[0] + moved[1] * whole[1] + moved[2] * whole[2];
        return along > 0.985 * length * Math.hypot(...whole);
      });
      if (isTowards) towards++;
    }
    return { towards, all };
  },
  // Shows the layers again that are ticked.
  layers: () => {
    for (const box of document.querySelectorAll("#viewer [data-layer]"))
      waysideViewer.view.state.layers[box.dataset.layer] = box.checked;
    waysideViewer.draw();
  },
  // Colour of marks, as bytes; nothing moves towards one that has no name.
  mark: (name) => {
    const colour = waysideViewer.view.state.colours.named[name] ?? [NaN, NaN, NaN];
    return colour.slice(0, 3).map((value) => 255 * value);
  },
};
null`;

/** Opens a page with a view, in a window of this size and theme. */
export async function openView(page, url, [width, height] = [1400, 900], scheme = "light") {
  await page.size(width, height);
  await page.theme(scheme);
  await page.open(url);
  await page.value(LOOK);
  await settled(page);
}

/** Waits until what was asked for is drawn. */
export async function settled(page) {
  await pause(100);
  await page.value("look.settled()");
}
