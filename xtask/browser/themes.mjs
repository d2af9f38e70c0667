// Light and dark: colours of background and words, and their contrast (WCAG 2.2, 1.4.3 and 1.4.11), in the
// page and in what its view draws.

import { pause } from "./chromium.mjs";
import { openView, settled } from "./looks.mjs";
import { SCHEMES, SIZES } from "./pictures.mjs";
import { holds } from "./tally.mjs";

/** Least contrast of words, and of what else is to be told apart. */
const WORDS = 4.5;
const MARKS = 3;

// Colours as [red, green, blue, opacity], read from a pixel, so that any way to write them is known.
const COLOUR = `
  const probe = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
  const rgba = (css) => {
    probe.clearRect(0, 0, 1, 1);
    probe.fillStyle = css;
    probe.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = probe.getImageData(0, 0, 1, 1).data;
    return [r, g, b, a / 255];
  };
  const over = ([r, g, b, a], behind) => [r, g, b].map((value, c) => a * value + (1 - a) * behind[c]);
  const luminance = (colour) => {
    const [r, g, b] = colour.map((value) => value / 255).map((v) =>
      v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const contrast = (one, other) => {
    const [a, b] = [luminance(one), luminance(other)];
    return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  };`;

// Every element with words of its own, with its least contrast. Names over the picture may lie on anything:
// black and white are tried. Words of a drawing lie on its paper, or on their own rim.
const ALL_WORDS = `(() => {${COLOUR}
  const style = (element) => getComputedStyle(element);
  const paper = rgba(style(document.body).backgroundColor).slice(0, 3);
  const layers = (element) => {
    const found = [];
    for (let at = element; at && at.id !== "viewer-names"; at = at.parentElement) {
      const { backgroundColor, backgroundImage } = style(at);
      const bar = at.matches(".viewer-share") && /(color|rgba?)\\([^()]*\\)/.exec(backgroundImage);
      if (bar) found.push(rgba(bar[0]));
      found.push(rgba(backgroundColor));
      if (found.at(-1)[3] === 1) break;
    }
    return found;
  };
  const rimOf = (text) => text.previousElementSibling?.matches("text[aria-hidden]") &&
    text.previousElementSibling.textContent === text.textContent && text.previousElementSibling;
  const behind = (element) => {
    if (element.ownerSVGElement) {
      const rim = rimOf(element);
      const sheet = element.ownerSVGElement.querySelector(".paper");
      return [rgba(rim ? style(rim).stroke : style(sheet).fill).slice(0, 3)];
    }
    const grounds = element.closest("#viewer-names") ? [[0, 0, 0], [255, 255, 255]] : [paper];
    return grounds.map((ground) => layers(element).reduceRight((below, layer) => over(layer, below), ground));
  };
  const hasWords = (element) => [...element.childNodes].some((node) =>
    node.nodeType === Node.TEXT_NODE && node.textContent.trim());
  const silent = "script, style, noscript, title, option, text[aria-hidden]";
  const isShown = (element) => !element.matches(silent) && element.getClientRects().length > 0 &&
    element.checkVisibility({ visibilityProperty: true });
  const all = [...document.body.querySelectorAll("*")];
  const told = all.filter((element) => hasWords(element) && isShown(element)).map((element) => {
    const own = rgba(element.ownerSVGElement ? style(element).fill : style(element).color);
    const least = Math.min(...behind(element).map((ground) => contrast(over(own, ground), ground)));
    return { words: element.textContent.trim().slice(0, 40), tag: element.localName, least };
  });
  return {
    background: luminance(paper),
    ink: luminance(rgba(style(document.body).color).slice(0, 3)),
    count: told.length,
    names: document.querySelectorAll("#viewer-names > *").length,
    worst: told.sort((a, b) => a.least - b.least).slice(0, 3),
  };
})()`;

// Axes of the canvases: their paper, and the most contrast left of and below what they frame, which is that
// of their numbers. The picture: its sky is paper. Legends: they have the colours of what is drawn.
const DRAWN = `(() => {${COLOUR}
  const paper = rgba(getComputedStyle(document.body).backgroundColor).slice(0, 3);
  const isPaper = (pixel) => [0, 1, 2].every((c) => pixel[c] === paper[c]);
  const sheets = ["map", "range", "doppler", "cut", "chart"].filter((name) =>
    document.getElementById("viewer-" + name)?.getContext("2d"));
  const axes = sheets.map((name) => {
    const { data, width, height } = look.canvas(name);
    const pixel = (x, y) => [...data.slice(4 * (y * width + x), 4 * (y * width + x) + 3)];
    const most = (x0, x1, y0, y1) => {
      let best = 0;
      for (let y = y0; y < y1; y++)
        for (let x = x0; x < x1; x++) best = Math.max(best, contrast(pixel(x, y), paper));
      return best;
    };
    const left = most(20, 48, 10, height - 44);
    const below = most(50, width - 12, height - 37, height - 20);
    return { name, isPaper: isPaper(pixel(2, 2)), left, below };
  });
  const { state, space } = waysideViewer.view;
  const pixels = look.space();
  const sky = [...pixels.slice(-4 * space.canvas.width + 8, -4 * space.canvas.width + 11)];
  const swatches = [...document.querySelectorAll("#viewer-orders i")].map((swatch) => {
    const colour = rgba(getComputedStyle(swatch).backgroundColor).slice(0, 3);
    const isDrawn = MARKS_OF.some((mark) => mark.every((value, c) => Math.abs(value - colour[c]) <= 1));
    return { isDrawn, contrast: contrast(colour, paper) };
  });
  return { axes, sky, isSkyPaper: isPaper(sky), swatches };
})()`.replace(
  "MARKS_OF",
  "[0, 1, 2, 3, 4, 5].map((i) => state.colours.marks.slice(4 * i, 4 * i + 3).map((v) => 255 * v))",
);

/** Looks at a page in both sizes, light first, and dark without opening it anew. */
export async function colourIsReadable(page, name, url) {
  for (const size of SIZES) {
    await openView(page, url, size);
    for (const scheme of SCHEMES) {
      await page.theme(scheme);
      await pause(200);
      await settled(page);
      const where = `${name} of ${size[0]} pixels, ${scheme}`;
      const words = await page.value(ALL_WORDS);
      const isOf = scheme === "dark" ? words.background < 0.05 : words.background > 0.9;
      const isInk = scheme === "dark" ? words.ink > 0.6 : words.ink < 0.05;
      holds(`${where}: has its background and its ink`, isOf && isInk, words);
      const isRead = words.count > 40 && words.worst[0].least >= WORDS;
      holds(`${where}: has words of a contrast of ${WORDS}`, isRead, words);
      await drawnIsReadable(page, where);
    }
  }
}

async function drawnIsReadable(page, where) {
  const { axes, sky, isSkyPaper, swatches } = await page.value(DRAWN);
  const isAxis = (axis) => axis.isPaper && axis.left >= WORDS && axis.below >= WORDS;
  holds(`${where}: draws numbers of that contrast`, axes.length > 0 && axes.every(isAxis), axes);
  holds(`${where}: draws its picture on the page's paper`, isSkyPaper, sky);
  const isLegend = (swatch) => swatch.isDrawn && swatch.contrast >= MARKS;
  holds(`${where}: has a legend in the colours that are drawn`, swatches.every(isLegend), swatches);
}
