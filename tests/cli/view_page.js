// Runs the page of `welter view` as a browser would, without one: `node view_page.js PAGE.html`. Prints what it saw as JSON.
"use strict";
const fs = require("fs");

const html = fs.readFileSync(process.argv[2], "utf8");
const data = new Map([...html.matchAll(/<script type="text\/plain" id="(data-\d+)">([^<]*)<\/script>/g)].map((m) => [m[1], m[2]]));
const script = html.match(/<script>\n([\s\S]*?)<\/script>/)[1];
const { Viewer, meta } = new Function(`${script}\nreturn { Viewer, meta };`)();

// What the page asks of a browser.
const elements = new Map(), requested = [], observers = [];
const element = (id) => {
  if (!elements.has(id)) {
    const listeners = {};
    elements.set(id, {
      id, listeners, textContent: data.get(id) ?? "", clientWidth: 320, clientHeight: 240, width: 0, height: 0,
      addEventListener: (name, does) => { listeners[name] = does; },
      setPointerCapture: () => {},
      getContext: () => ({
        createImageData: (width, height) => ({ width, height, data: new Uint8ClampedArray(4 * width * height) }),
        putImageData: (image) => { painted = image; },
      }),
    });
  }
  return elements.get(id);
};
let painted = null;
const keys = {};
globalThis.document = { getElementById: element, addEventListener: (name, does) => { keys[name] = does; } };
globalThis.requestAnimationFrame = (does) => requested.push(does);
globalThis.ResizeObserver = class { constructor(does) { observers.push(does); } observe() {} };

const settle = async () => {
  while (requested.length > 0) {
    requested.shift()();
    await new Promise((done) => setTimeout(done, 100));
  }
};
const hash = (image) => image.data.reduce((sum, byte) => (sum * 31 + byte) >>> 0, 7);

(async () => {
  const frames = [];
  for (let k = 0; k < meta.frames.length; k++) {
    const frame = await Viewer.read(data.get(`data-${k}`), meta.frames[k]);
    const pixels = new Uint8ClampedArray(4 * 320 * 240), options = { edges: false, flat: false };
    Viewer.draw(frame, Viewer.camera(meta), 320, 240, pixels, options);
    let covered = 0;
    for (let i = 0; i < pixels.length; i += 4) covered += pixels[i] !== 250 || pixels[i + 1] !== 248 ? 1 : 0;
    const extent = [0, 1, 2].map((axis) => {
      let [least, greatest] = [Infinity, -Infinity];
      for (let i = axis; i < frame.positions.length; i += 3) {
        least = Math.min(least, frame.positions[i]);
        greatest = Math.max(greatest, frame.positions[i]);
      }
      return [least, greatest];
    });
    frames.push({ vertices: frame.vertices, triangles: frame.triangles, covered, extent, middle: [...pixels.slice(4 * (120 * 320 + 160), 4 * (120 * 320 + 160) + 3)] });
  }
  Viewer.start(meta);
  await settle();
  const pictures = [hash(painted)], texts = [element("what").textContent];
  const key = async (name) => {
    keys.keydown({ key: name, target: null, preventDefault: () => {} });
    await settle();
    pictures.push(hash(painted));
    texts.push(element("what").textContent);
  };
  await key("e");
  await key("f");
  await key("ArrowRight");
  element("view").listeners.pointerdown({ clientX: 0, clientY: 0, button: 0, shiftKey: false, pointerId: 1 });
  element("view").listeners.pointermove({ clientX: 50, clientY: 20 });
  element("view").listeners.pointerup({});
  element("view").listeners.wheel({ deltaY: -100, preventDefault: () => {} });
  await settle();
  pictures.push(hash(painted));
  console.log(JSON.stringify({ meta, frames, pictures, texts }));
})();
