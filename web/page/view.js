// The camera: mouse, touch and keys on the picture.
'use strict';

const DEGREES = Math.PI / 180;
const rounded = (value, digits) => Number(value.toFixed(digits));

/// Lets `canvas` turn, move and zoom a camera. `read` gives the camera's values, `change` takes new ones.
function makeView(canvas, read, change) {
  const pointers = new Map();
  let button = 0;

  function orbit(dx, dy) {
    const { polar, azimuth } = read();
    change({
      'camera.polar': rounded(Math.min(179, Math.max(1, polar - dy)), 2),
      'camera.azimuth': rounded(azimuth - dx, 2),
    });
  }

  function zoom(factor) {
    change({ 'camera.distance': rounded(Math.min(100, Math.max(0.05, read().distance * factor)), 4) });
  }

  /// Moves the target by parts of the picture's height.
  function pan(dx, dy) {
    const { target, distance, polar, azimuth } = read();
    const metres = 2 * distance * Math.tan(17.5 * DEGREES);
    const [sinP, cosP] = [Math.sin(polar * DEGREES), Math.cos(polar * DEGREES)];
    const [sinA, cosA] = [Math.sin(azimuth * DEGREES), Math.cos(azimuth * DEGREES)];
    const right = [cosA, 0, -sinA];
    const up = [-cosP * sinA, sinP, -cosP * cosA];
    change({ 'camera.target': target.map((x, i) => rounded(x + metres * (dy * up[i] - dx * right[i]), 4)) });
  }

  const place = (event) => [event.clientX, event.clientY];
  const span = ([a, b]) => Math.hypot(a[0] - b[0], a[1] - b[1]);
  const middle = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];

  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, place(event));
    button = event.button;
    canvas.focus();
    event.preventDefault();
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!pointers.has(event.pointerId)) return;
    const before = [...pointers.values()];
    pointers.set(event.pointerId, place(event));
    const after = [...pointers.values()];
    const height = canvas.clientHeight;
    if (after.length === 2) {
      const [from, to] = [middle(before), middle(after)];
      pan((to[0] - from[0]) / height, (to[1] - from[1]) / height);
      if (span(after) > 0) zoom(span(before) / span(after));
    } else if (after.length === 1) {
      const [dx, dy] = [after[0][0] - before[0][0], after[0][1] - before[0][1]];
      if (button !== 0 || event.shiftKey) pan(dx / height, dy / height);
      else orbit(dx * 0.5, dy * 0.5);
    }
  });
  for (const end of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(Math.exp(event.deltaY * 0.001));
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    const move = event.shiftKey
      ? { ArrowLeft: () => pan(-0.05, 0), ArrowRight: () => pan(0.05, 0), ArrowUp: () => pan(0, -0.05), ArrowDown: () => pan(0, 0.05) }
      : { ArrowLeft: () => orbit(-5, 0), ArrowRight: () => orbit(5, 0), ArrowUp: () => orbit(0, -5), ArrowDown: () => orbit(0, 5) };
    const action = move[event.key] ?? { '+': () => zoom(0.9), '=': () => zoom(0.9), '-': () => zoom(1 / 0.9) }[event.key];
    if (!action) return;
    action();
    event.preventDefault();
  });
}
