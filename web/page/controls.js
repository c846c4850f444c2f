// The controls: made from lists, and set to the values of the scene.
'use strict';

/// Sliders over keys of the scene. `mark` names the stability mark; `log` sliders are even in the logarithm.
const CLOTH_SLIDERS = [
  { path: 'cloth.ks', label: 'stiffness ks', unit: 'N/m', from: 50, to: 500000, log: true, digits: 3, mark: 'ks' },
  { path: 'cloth.density', label: 'density', unit: 'kg/m²', from: 0.5, to: 1500, log: true, digits: 3, mark: 'density' },
  { path: 'cloth.damping', label: 'damping', unit: '%', from: 0, to: 2, step: 0.01, mark: 'damping' },
  { path: 'sim.gravity', label: 'gravity (y)', unit: 'm/s²', from: -20, to: 20, step: 0.1 },
  { path: 'sim.steps_per_frame', label: 'steps a frame', unit: '', from: 1, to: 200, log: true, whole: true, mark: 'steps_per_frame' },
];
const METHOD_CHOICES = [
  { path: 'sim.integrator', label: 'integrator' },
  { path: 'sim.contact', label: 'contact' },
  { path: 'sim.self_collision', label: 'self-collision' },
];
const SPRINGS = [
  { path: 'cloth.enable_structural', label: 'structural springs' },
  { path: 'cloth.enable_shearing', label: 'shearing springs' },
  { path: 'cloth.enable_bending', label: 'bending springs' },
];
/// Constants of materials.
const LOOK_SLIDERS = {
  ka: { label: 'ambient ka', from: 0, to: 1, step: 0.01 },
  kd: { label: 'diffuse kd', from: 0, to: 2, step: 0.01 },
  ks: { label: 'highlight ks', from: 0, to: 2, step: 0.01 },
  shininess: { label: 'shininess', from: 1, to: 256, step: 1 },
  km: { label: 'mirror km', from: 0, to: 1, step: 0.01 },
  normal_scaling: { label: 'normal scaling', from: 0, to: 200, step: 1 },
  height_scaling: { label: 'height scaling', from: 0, to: 0.2, step: 0.001 },
};
const LIT = ['color', 'ka', 'kd', 'ks', 'shininess'];
const RELIEF = ['height_map', 'normal_scaling', 'height_scaling'];
/// The constants that each shader reads.
const READS = {
  wireframe: ['color'], normal: [], diffuse: ['color', 'kd'], phong: LIT, texture: ['texture'],
  bump: [...LIT, ...RELIEF], displacement: [...LIT, ...RELIEF], mirror: ['environment'],
  custom: [...LIT.slice(1), 'km', ...RELIEF, 'texture', 'environment'],
};

let serial = 0;

function make(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/// A row with a label and what it labels.
function field(label, control, ...more) {
  control.id ||= `control${serial++}`;
  return make('div', { className: more.length ? 'field slider' : 'field' },
    make('label', { htmlFor: control.id, textContent: label }), ...(more.length ? more : [control]));
}

/// A slider with a number beside it. `change` gets the new value. Returns the row, and functions that set it.
function makeSlider(settings, change) {
  const { label, unit, from, to, log, whole } = settings;
  const steps = 1000;
  const place = (value) => log
    ? Math.log(Math.max(value, from) / from) / Math.log(to / from)
    : (value - from) / (to - from);
  const value = (part) => {
    if (!log) return Number((from + Math.round(part * (to - from) / settings.step) * settings.step).toFixed(4));
    const exact = from * (to / from) ** part;
    return whole ? Math.round(exact) : Number(exact.toPrecision(settings.digits));
  };
  const full = unit ? `${label}, ${unit}` : label;
  const slider = make('input', { type: 'range', min: 0, max: steps, step: 1, id: `slider-${settings.path ?? settings.name}` });
  const number = make('input', { type: 'number', step: 'any', title: full });
  number.setAttribute('aria-label', full);
  const marks = ['at rest', 'at worst'].map((when) => make('span', { className: when === 'at rest' ? 'mark' : 'mark worst', hidden: true, title: `unstable ${when} beyond here` }));
  const say = (x) => slider.setAttribute('aria-valuetext', `${x} ${unit}`.trim());
  slider.addEventListener('input', () => {
    const x = value(slider.value / steps);
    number.value = x;
    say(x);
    change(x);
  });
  number.addEventListener('change', () => {
    if (number.value !== '' && Number.isFinite(number.valueAsNumber)) change(number.valueAsNumber);
  });
  const row = field(label, slider, make('span', { className: 'track' }, slider, ...marks), number);
  row.title = full;
  return {
    row,
    set(x) {
      if (document.activeElement !== slider) slider.value = steps * Math.min(1, Math.max(0, place(x)));
      if (document.activeElement !== number) number.value = x;
      say(x);
    },
    mark(values) {
      marks.forEach((mark, i) => {
        const at = values?.[i];
        mark.hidden = at === null || at === undefined || at < from || at > to;
        // The thumb is 16 pixels wide and stays inside the track.
        if (!mark.hidden) mark.style.left = `calc(8px + (100% - 16px) * ${place(at)})`;
        if (!mark.hidden) mark.title = `unstable ${i ? 'at worst' : 'at rest'} beyond ${Number(at.toPrecision(4))}`;
      });
    },
  };
}

/// Fills a list of choices: pairs of a value and a title, or values.
function fill(select, options) {
  select.replaceChildren(...options.map((option) => {
    const [value, title, text] = [option].flat();
    return make('option', { value, title: title ?? '', textContent: text ?? value });
  }));
}

function makeChoice(label, options, change) {
  const select = make('select');
  fill(select, options);
  select.addEventListener('change', () => change(select.value));
  return { row: field(label, select), select };
}

function makeCheck(label, change) {
  const box = make('input', { type: 'checkbox' });
  box.addEventListener('change', () => change(box.checked));
  return { row: make('label', {}, box, label), box };
}

const hex = (color) => '#' + color.map((x) => Math.round(255 * Math.min(1, Math.max(0, x))).toString(16).padStart(2, '0')).join('');
const unhex = (text) => [1, 3, 5].map((at) => Number((parseInt(text.slice(at, at + 2), 16) / 255).toFixed(3)));

/// All controls. `change` takes new values by path; `look` takes a constant of the chosen object's material.
function makeControls(choices, change, look) {
  let gravity = [0, 0, 0];
  const sliders = CLOTH_SLIDERS.map((settings) => [settings, makeSlider(settings, (x) => {
    change({ [settings.path]: settings.path === 'sim.gravity' ? [gravity[0], x, gravity[2]] : x });
  })]);
  element('cloth-fields').replaceChildren(...sliders.map(([, slider]) => slider.row));
  const springs = SPRINGS.map(({ path, label }) => [path, makeCheck(label, (on) => change({ [path]: on }))]);
  const methods = METHOD_CHOICES.map(({ path, label }) =>
    [path, makeChoice(label, choices.keys[path], (name) => change({ [path]: name }))]);
  element('method-fields').replaceChildren(...methods.map(([, choice]) => choice.row),
    make('div', { className: 'checks' }, ...springs.map(([, check]) => check.row)));

  const light = ['x', 'y', 'z'].map((axis) => make('input', { type: 'number', step: 0.1, title: `position ${axis} of the light, m`, ariaLabel: `position ${axis} of the light, m` }));
  const position = () => light.map((input) => input.valueAsNumber);
  light.forEach((input) => input.addEventListener('change', () => {
    if (position().every(Number.isFinite)) change({ 'light.position': position() });
  }));
  const intensity = makeSlider({ label: 'intensity', unit: '', name: 'intensity', from: 0, to: 20, step: 0.1 }, (x) => change({ 'light.intensity': [x, x, x] }));
  const row = make('div', { className: 'field' }, make('span', { textContent: 'position' }), make('span', { className: 'three' }, ...light));
  element('light-fields').replaceChildren(row, intensity.row);

  let shown = { kind: null, made: [] };
  return {
    /// Shows the values of a scene.
    show({ values, gauge }) {
      gravity = values['sim.gravity'];
      element('cloth').hidden = values['cloth.ks'] === undefined;
      for (const [{ path, mark }, slider] of sliders) {
        const value = path === 'sim.gravity' ? gravity[1] : values[path];
        if (value !== undefined) slider.set(value);
        if (mark) slider.mark(gauge?.marks[mark]);
      }
      methods.forEach(([path, { select }]) => { select.value = values[path]; });
      springs.forEach(([path, { box, row }]) => { box.checked = values[path]; row.hidden = values[path] === undefined; });
      light.forEach((input, i) => { if (document.activeElement !== input) input.value = values['light.position'][i]; });
      intensity.set(values['light.intensity'][0]);
    },
    /// Shows the constants of a material. Its controls are made anew only when they are others.
    showLook(object, textures) {
      const kind = [object.path, object.shader, ...textures].join();
      if (kind !== shown.kind) {
        const made = READS[object.shader].map((key) => [key, lookControl(key, look, [...choices.textures, ...textures])]);
        element('look-fields').replaceChildren(...made.map(([, control]) => control.row));
        shown = { kind, made };
      }
      shown.made.forEach(([key, control]) => control.set(object[key]));
    },
  };
}

/// The control of a material's constant.
function lookControl(key, look, textures) {
  if (key in LOOK_SLIDERS) return makeSlider({ ...LOOK_SLIDERS[key], unit: '', name: key }, (x) => look(key, x));
  if (key === 'color') {
    const input = make('input', { type: 'color' });
    input.addEventListener('input', () => look('color', unhex(input.value)));
    return { row: field('colour', input), set: (color) => { input.value = hex(color); } };
  }
  const label = { texture: 'texture', height_map: 'height map', environment: 'environment' }[key];
  const known = key === 'environment' ? ['cube'] : textures;
  const { row, select } = makeChoice(label, known, (name) => look(key, name));
  const set = (name) => {
    if (![...select.options].some((option) => option.value === name)) fill(select, [...known, name]);
    select.value = name;
  };
  return { row, set };
}
