// Draws surfaces into arrays of pixels, without a graphics card, and turns them with the pointer.
// The page holds `meta` and, for each frame, its data in an element of its own.
"use strict";

const Viewer = (() => {
  // Colours (red, green, blue from 0 to 1) of the front, of the back, and of what lies behind.
  const FRONT = [0.62, 0.72, 0.82], BACK = [0.87, 0.45, 0.2], BEHIND = [250, 248, 245];
  // Cosine and share of the light that comes from everywhere.
  const AMBIENT = 0.25;

  const toBytes = (text) => {
    const binary = atob(text), bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
    return bytes;
  };

  const inflate = async (bytes) => {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };

  // Differences, zigzag coded, in planes of bytes: the inverse of `frame.rs`.
  const numbers = (bytes, at, count, width) => {
    const out = new Int32Array(count);
    let last = 0;
    for (let i = 0; i < count; i++) {
      let code = 0;
      for (let k = 0; k < width; k++) code |= bytes[at + k * count + i] << (8 * k);
      last = (last + ((code >>> 1) ^ -(code & 1))) | 0;
      out[i] = last;
    }
    return out;
  };

  // In the unit of the page: the side of the cube around all frames. That of the frame lies at `place` in it.
  const unpack = (bytes, place) => {
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    const vertices = view.getUint32(0, true), triangles = view.getUint32(4, true);
    const colored = view.getUint32(8, true) === 1;
    let at = 12;
    const positions = new Float32Array(3 * vertices);
    for (let axis = 0; axis < 3; axis++) {
      const steps = numbers(bytes, at, vertices, 3);
      at += 3 * vertices;
      for (let i = 0; i < vertices; i++) positions[3 * i + axis] = place.corner[axis] + steps[i] * (place.side / 1048576);
    }
    const corners = new Uint32Array(numbers(bytes, at, 3 * triangles, 4));
    at += 12 * triangles;
    const colors = colored ? bytes.subarray(at, at + 3 * triangles) : null;
    return { vertices, triangles, positions, corners, colors };
  };

  const read = async (text, place) => unpack(await inflate(toBytes(text)), place);

  // Twice the area of a triangle times its normal, into `out`.
  const normalOf = (p, a, b, c, out) => {
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    out[0] = uy * vz - uz * vy;
    out[1] = uz * vx - ux * vz;
    out[2] = ux * vy - uy * vx;
  };

  // Unit normals at vertices: means over the triangles around, weighted by area.
  const normalsOf = (frame) => {
    const normals = new Float32Array(3 * frame.vertices), n = new Float64Array(3), corners = frame.corners;
    for (let t = 0; t < corners.length; t += 3) {
      normalOf(frame.positions, 3 * corners[t], 3 * corners[t + 1], 3 * corners[t + 2], n);
      for (let k = 0; k < 3; k++) {
        const at = 3 * corners[t + k];
        normals[at] += n[0];
        normals[at + 1] += n[1];
        normals[at + 2] += n[2];
      }
    }
    for (let i = 0; i < normals.length; i += 3) {
      const length = Math.sqrt(normals[i] ** 2 + normals[i + 1] ** 2 + normals[i + 2] ** 2) || 1;
      normals[i] /= length;
      normals[i + 1] /= length;
      normals[i + 2] /= length;
    }
    return normals;
  };

  // Right, up and toward the eye, as rows.
  const axesOf = (camera) => {
    const a = camera.azimuth, e = camera.elevation;
    const toward = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
    const right = [-Math.sin(a), Math.cos(a), 0];
    const up = [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)];
    return [right, up, toward].map((v) => camera.up === "y" ? [v[1], v[2], v[0]] : v);
  };

  // Draws a frame into `pixels` (red, green, blue, opacity by bytes), rows from the top; how many times a pixel was written.
  const draw = (frame, camera, width, height, pixels, options) => {
    for (let i = 0; i < 4 * width * height; i += 4) {
      pixels[i] = BEHIND[0];
      pixels[i + 1] = BEHIND[1];
      pixels[i + 2] = BEHIND[2];
      pixels[i + 3] = 255;
    }
    if (!frame.normals && !options.flat) frame.normals = normalsOf(frame);
    const [right, up, toward] = axesOf(camera), [tx, ty, tz] = camera.target;
    const focal = Math.min(width, height) / (2 * Math.tan(camera.angle / 2)), near = camera.distance * 1e-3;
    const n = frame.vertices, p = frame.positions, normals = frame.normals, corners = frame.corners;
    // Places on the screen, one over the distance (0 behind the eye), and the cosine with the light, which is at the eye.
    const sx = new Float32Array(n), sy = new Float32Array(n), sw = new Float32Array(n), lit = new Float32Array(n);
    for (let i = 0; i < n; i++) {
      const x = p[3 * i] - tx, y = p[3 * i + 1] - ty, z = p[3 * i + 2] - tz;
      const away = camera.distance - (toward[0] * x + toward[1] * y + toward[2] * z);
      const w = away > near ? 1 / away : 0;
      sw[i] = w;
      sx[i] = width / 2 + focal * w * (right[0] * x + right[1] * y + right[2] * z);
      sy[i] = height / 2 - focal * w * (up[0] * x + up[1] * y + up[2] * z);
      if (!options.flat) {
        lit[i] = Math.abs(toward[0] * normals[3 * i] + toward[1] * normals[3 * i + 1] + toward[2] * normals[3 * i + 2]);
      }
    }
    const depth = new Float32Array(width * height), normal = new Float64Array(3), edges = options.edges;
    let drawn = 0;
    for (let t = 0; t < frame.triangles; t++) {
      const a = corners[3 * t], b = corners[3 * t + 1], c = corners[3 * t + 2];
      if (sw[a] === 0 || sw[b] === 0 || sw[c] === 0) continue;
      const ax = sx[a], ay = sy[a], bx = sx[b], by = sy[b], cx = sx[c], cy = sy[c];
      const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
      const x0 = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5));
      const x1 = Math.min(width - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
      const y0 = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5));
      const y1 = Math.min(height - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
      if (!(area !== 0 && x0 <= x1 && y0 <= y1)) continue;
      // Rows go down, so counterclockwise triangles have a negative area.
      const front = area < 0, own = front && frame.colors !== null, color = front ? FRONT : BACK;
      const red = 255 * (own ? frame.colors[3 * t] / 255 : color[0]);
      const green = 255 * (own ? frame.colors[3 * t + 1] / 255 : color[1]);
      const blue = 255 * (own ? frame.colors[3 * t + 2] / 255 : color[2]);
      let la = lit[a], lb = lit[b], lc = lit[c];
      if (options.flat) {
        normalOf(p, 3 * a, 3 * b, 3 * c, normal);
        const length = Math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2) || 1;
        la = lb = lc = Math.abs(toward[0] * normal[0] + toward[1] * normal[1] + toward[2] * normal[2]) / length;
      }
      // Distances from the sides in pixels are weights times these.
      const far = Math.abs(area);
      const ha = far / (Math.hypot(cx - bx, cy - by) || 1), hb = far / (Math.hypot(ax - cx, ay - cy) || 1);
      const hc = far / (Math.hypot(bx - ax, by - ay) || 1);
      const wax = -(cy - by) / area, wbx = -(ay - cy) / area;
      for (let y = y0; y <= y1; y++) {
        const py = y + 0.5;
        const wa0 = ((cx - bx) * (py - by) + (cy - by) * bx) / area, wb0 = ((ax - cx) * (py - cy) + (ay - cy) * cx) / area;
        for (let x = x0, at = y * width + x0; x <= x1; x++, at++) {
          const px = x + 0.5, wa = wa0 + wax * px, wb = wb0 + wbx * px, wc = 1 - wa - wb;
          if (wa < 0 || wb < 0 || wc < 0) continue;
          const w = wa * sw[a] + wb * sw[b] + wc * sw[c];
          if (w <= depth[at]) continue;
          depth[at] = w;
          drawn++;
          let shade = AMBIENT + (1 - AMBIENT) * (wa * la + wb * lb + wc * lc);
          if (edges && Math.min(wa * ha, wb * hb, wc * hc) < 0.6) shade *= 0.35;
          pixels[4 * at] = shade * red;
          pixels[4 * at + 1] = shade * green;
          pixels[4 * at + 2] = shade * blue;
        }
      }
    }
    return drawn;
  };

  // A camera from which the whole box is seen.
  const camera = (meta) => ({
    azimuth: 0.9, elevation: 0.4, angle: 0.7, up: meta.up,
    target: meta.center.slice(), distance: 0.9 * meta.radius / Math.sin(0.35),
  });

  const start = (meta) => {
    const $ = (id) => document.getElementById(id);
    const canvas = $("view"), context = canvas.getContext("2d"), slider = $("frame");
    const frames = new Map(), options = { edges: false, flat: false };
    let eye = camera(meta), now = 0, playing = null, coarse = false, waiting = false, slow = false;
    slider.max = meta.frames.length - 1;
    $("controls").hidden = meta.frames.length < 2;

    const frameAt = async (k) => {
      if (!frames.has(k)) {
        // So many are kept at most.
        if (frames.size > 60) frames.delete(frames.keys().next().value);
        frames.set(k, await read($(`data-${k}`).textContent, meta.frames[k]));
      }
      return frames.get(k);
    };
    const paint = async () => {
      waiting = false;
      const k = now, frame = await frameAt(k);
      const scale = coarse && slow ? 0.5 : 1;
      const width = Math.max(1, Math.round(canvas.clientWidth * scale));
      const height = Math.max(1, Math.round(canvas.clientHeight * scale));
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
      const image = context.createImageData(width, height), begin = performance.now();
      draw(frame, eye, width, height, image.data, options);
      if (scale === 1) slow = performance.now() - begin > 50;
      context.putImageData(image, 0, 0);
      $("what").textContent = `${meta.frames[k].name}: ${frame.vertices.toLocaleString("en")} vertices, ` +
        `${frame.triangles.toLocaleString("en")} triangles`;
      slider.value = k;
    };
    const failed = (error) => { $("what").textContent = `this page cannot be shown: ${error.message}`; };
    const ask = () => { if (!waiting) { waiting = true; requestAnimationFrame(() => paint().catch(failed)); } };
    const go = (k) => { now = (k + meta.frames.length) % meta.frames.length; ask(); };
    const play = () => {
      playing = playing === null ? setInterval(() => go(now + 1), 1000 / 24) : (clearInterval(playing), null);
      $("play").textContent = playing === null ? "Play" : "Pause";
    };
    const toggle = (name) => { options[name] = !options[name]; $(name).checked = options[name]; ask(); };

    let held = null;
    canvas.addEventListener("pointerdown", (event) => {
      held = [event.clientX, event.clientY, event.button !== 0 || event.shiftKey];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!held) return;
      const [dx, dy] = [event.clientX - held[0], event.clientY - held[1]];
      if (held[2]) {
        const [right, up] = axesOf(eye);
        const unit = 2 * eye.distance * Math.tan(eye.angle / 2) / Math.min(canvas.clientWidth, canvas.clientHeight);
        for (let k = 0; k < 3; k++) eye.target[k] += unit * (dy * up[k] - dx * right[k]);
      } else {
        eye.azimuth -= 0.008 * dx;
        eye.elevation = Math.max(-1.55, Math.min(1.55, eye.elevation + 0.008 * dy));
      }
      [held[0], held[1], coarse] = [event.clientX, event.clientY, true];
      ask();
    });
    const release = () => { held = null; coarse = false; ask(); };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      eye.distance *= Math.exp(Math.max(-1, Math.min(1, 0.002 * event.deltaY)));
      ask();
    }, { passive: false });
    document.addEventListener("keydown", (event) => {
      // What has the focus takes its own keys.
      const focus = event.target?.tagName;
      if ((focus === "INPUT" || focus === "BUTTON") && /^(Arrow|Home|End| )/.test(event.key)) return;
      const does = {
        " ": play, ArrowRight: () => go(now + 1), ArrowLeft: () => go(now - 1), Home: () => go(0), End: () => go(-1),
        e: () => toggle("edges"), f: () => toggle("flat"), r: () => { eye = camera(meta); ask(); },
      }[event.key];
      if (does) { event.preventDefault(); does(); }
    });
    slider.addEventListener("input", () => go(Number(slider.value)));
    $("play").addEventListener("click", play);
    for (const name of ["edges", "flat"]) $(name).addEventListener("change", () => toggle(name));
    new ResizeObserver(ask).observe(canvas);
    ask();
  };

  return { read, draw, camera, start };
})();
