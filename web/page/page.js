// The page: what is shown, what the worker says, and what the user does.
'use strict';

const SIZES = ['320x250', '640x500', '1024x800'];

let state = emptyState();
let started = false; // whether the engine has ever started
let worker;
let choices;
let controls;
let camera = null; // the values of the camera
let objects = []; // what is drawn
let values = {};
let order = 0; // the number of the last order to the worker
let error = '';
let moment = null; // the last picture's message
const textures = new Map(); // of the user's own, for a new worker
const plots = { energy: new Plot(element('energy'), ['kinetic', 'spring', 'gravitational']) };

/// Starts the engine in a worker of its own.
async function startWorker() {
  const packed = Uint8Array.from(atob(element('wasm').textContent.trim()), (letter) => letter.charCodeAt(0));
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  const wasm = await new Response(unpacked).arrayBuffer();
  const script = URL.createObjectURL(new Blob([element('worker').textContent], { type: 'text/javascript' }));
  worker = new Worker(script);
  worker.onmessage = ({ data }) => heard[data.type](data);
  worker.postMessage({ type: 'start', wasm }, [wasm]);
}

const heard = {
  ready(message) {
    if (!choices) {
      choices = message.choices;
      plots.ledger = new Plot(element('ledger'), choices.ledger.map((name) => name.replace('_', ' ')));
      controls = makeControls(choices, change, changeLook);
      fill(element('shader'), choices.keys['material.shader'].map(([name, meaning]) => [name, meaning]));
    }
    for (const [name, bytes] of textures) worker.postMessage({ type: 'texture', name, bytes });
    if (started) ask(0);
    else openLink();
    started = true;
  },
  begin() {
    Object.values(plots).forEach((plot) => plot.clear());
  },
  loaded({ answer }) {
    showError('');
    showLoaded(answer);
    showStatus();
  },
  failed({ text }) { stop(text); },
  async broken({ text }) {
    worker.terminate();
    worker = null;
    stop(`error: ${text}\n  = help: the scene may be too large for a browser; open another one`);
    state = { ...emptyState(), paused: true };
  },
  progress({ frame, goal }) { element('speed').textContent = `at frame ${frame} of ${goal}`; },
  picture(message) { requestAnimationFrame(() => showPicture(message)); },
  texture() {},
  file({ what, bytes, frame }) {
    const name = state.scene.replace(/\.json$/, '');
    if (what === 'png') save(`${name}-${frame}.png`, bytes, 'image/png');
    else save(`${name}-${frame}.bin`, bytes, 'application/octet-stream');
  },
};

/// Asks the engine for what the state says. `frame` is where to simulate to; without it, the frame that is shown.
function ask(frame = null) {
  if (!worker) {
    startWorker();
    return;
  }
  if (frame !== null) ['frame', 'state-hash', 'picture-hash'].forEach((id) => { element(id).textContent = ''; });
  tell({ type: 'load', request: requestOf(state), frame, play: !state.paused });
  showStatus();
}

/// Gives the worker an order. Pictures say which orders they follow.
function tell(message) {
  order += 1;
  worker?.postMessage({ ...message, id: order });
}

/// Opens the moment that the address names.
function openLink() {
  showError('');
  try {
    state = parseLink(location.hash);
  } catch (text) {
    state = { ...emptyState(), paused: true };
    stop(String(text));
    return;
  }
  if (!location.hash && matchMedia('(prefers-reduced-motion: reduce)').matches) state.paused = true;
  const { frame } = state;
  state.frame = null;
  ask(frame ?? 0);
}

/// Shows an error and stops.
function stop(text) {
  showError(text);
  state.paused = true;
  showStatus();
}

function showError(text) {
  error = text;
  element('errors').textContent = text;
  element('errors').hidden = !text;
  element('unstable-box').hidden = !state.allow_unstable && !text.includes('--allow-unstable');
}

/// Running, paused, or the error. While an answer or a picture is awaited, it is running.
function showStatus() {
  const waits = moment?.id !== order;
  const text = error || (state.paused && !waits ? 'paused' : 'running');
  if (element('status').textContent !== text) element('status').textContent = text;
  element('status').title = error;
  element('play').textContent = state.paused ? 'Play' : 'Pause';
}

function showLoaded(answer) {
  ({ objects, values } = answer);
  camera = {
    target: values['camera.target'], distance: values['camera.distance'],
    polar: values['camera.polar'], azimuth: values['camera.azimuth'],
  };
  controls.show(answer);
  showGauge(answer.gauge);
  const chosen = element('object').value;
  fill(element('object'), [['', '', 'all'], ...objects.map(({ path }) => path)]);
  element('object').value = objects.some(({ path }) => path === chosen) ? chosen : '';
  showLook(answer.textures);
  element('warnings').textContent = answer.warnings.join('\n\n');
  element('warnings').hidden = !answer.warnings.length;
  const stock = Object.keys(choices.scenes);
  const scenes = state.text === null ? stock : [...stock, state.scene];
  fill(element('scene'), scenes);
  element('scene').value = state.scene;
  const size = values['render.size'].join('x');
  fill(element('size'), SIZES.includes(size) ? SIZES : [...SIZES, size]);
  element('size').value = size;
  element('allow-unstable').checked = state.allow_unstable;
  element('ledger-on').checked = state.ledger;
  element('ledger').querySelector('canvas').hidden = !state.ledger;
  if (document.activeElement !== element('text')) element('text').value = sceneText();
}

function showLook(own = showLook.own) {
  showLook.own = own;
  const path = element('object').value;
  const object = objects.find((object) => object.path === path) ?? objects[0];
  if (!object) return;
  element('shader').value = object.shader;
  controls.showLook({ ...object, path }, own);
}

function showGauge(gauge) {
  const line = element('gauge');
  if (!gauge) {
    line.textContent = 'dt·ω has no bound here: this method is stable at every step';
    return;
  }
  const part = (name, now, bound) => {
    const text = make('span', { textContent: `${name} ${now.toFixed(3)} of ${bound.toFixed(3)}` });
    if (now >= bound) text.className = 'over';
    return text;
  };
  line.replaceChildren('dt·ω: ', part('at rest', gauge.rest, gauge.limit), ', ', part('at worst', gauge.worst, gauge.limit_worst));
}

function showPicture(message) {
  moment = message;
  const canvas = element('view');
  if (canvas.width !== message.width || canvas.height !== message.height) {
    canvas.width = message.width;
    canvas.height = message.height;
  }
  const image = new ImageData(new Uint8ClampedArray(message.pixels.buffer), message.width, message.height);
  canvas.getContext('2d').putImageData(image, 0, 0);
  worker?.postMessage({ type: 'shown' });
  const last = message.rows.at(-1);
  const texts = {
    frame: message.frame,
    'state-hash': message.state,
    'picture-hash': message.picture,
    stretch: `${message.stretch.toFixed(4)} × rest length`,
    command: message.command,
    draw: `${message.draw.toFixed(1)} ms`,
  };
  if (last) texts.time = `${last[1].toFixed(3)} s`;
  if (message.simulate) texts.simulate = `${message.simulate.toFixed(1)} ms`;
  texts.rate = message.pictures ? message.pictures.toFixed(0) : '–';
  texts.speed = message.speed === undefined ? '' : message.speed > 0.97 ? 'real time' : `${message.speed.toFixed(1)} × real time`;
  for (const [id, text] of Object.entries(texts)) element(id).textContent = text;
  showRows(message.rows);
  if (state.paused) showAddress();
  showStatus();
}

function showRows(rows) {
  for (const [, time, kinetic, spring, gravitational, ...ledger] of rows) {
    plots.energy.add([time, kinetic, spring, gravitational]);
    if (ledger.length) plots.ledger.add([time, ...ledger]);
  }
  plots.energy.draw();
  if (state.ledger) plots.ledger.draw();
}

/// The link to the moment that is shown.
function link() {
  return formatLink({ ...state, frame: state.paused ? moment?.frame ?? null : null });
}

function showAddress() {
  if (location.hash !== link()) history.replaceState(null, '', link());
}

/// The scene file with all changes made in it.
function sceneText() {
  const text = state.text ?? choices.scenes[state.scene];
  if (text === undefined || !(state.sets.length || state.shader || state.size)) return text ?? '';
  let scene;
  try {
    scene = JSON.parse(text);
  } catch {
    return text;
  }
  const sets = state.sets.map((set) => [set.slice(0, set.indexOf('=')), set.slice(set.indexOf('=') + 1)]);
  if (state.shader) objects.forEach(({ path }) => sets.push([`${path}.material.shader`, state.shader]));
  if (state.size) sets.push(['render.size', `[${state.size.replace('x', ',')}]`]);
  for (const [path, value] of sets) {
    const steps = path.split('.');
    const last = steps.pop();
    const inside = steps.reduce((at, step) => at[step] ??= {}, scene);
    inside[last] = /^[a-z_][\w.-]*$/i.test(value) && !['true', 'false', 'null'].includes(value) ? value : JSON.parse(value);
  }
  return JSON.stringify(scene, null, 2) + '\n';
}

/// Changes values by path; `null` goes back to those of the file.
function change(changes) {
  for (const [path, value] of Object.entries(changes)) setValue(state, path, value);
  // The next change builds on these before the engine has answered.
  for (const [path, value] of Object.entries(changes)) {
    if (camera && path.startsWith('camera.')) camera[path.slice(7)] = value;
  }
  ask();
  if (!state.paused) showAddress();
}

/// Changes a constant of the chosen object, or of all.
function changeLook(key, value) {
  const path = element('object').value;
  change({ [path ? `${path}.material.${key}` : `material.${key}`]: value });
}

function chooseShader(name) {
  const path = element('object').value;
  if (!path) {
    objects.forEach((object) => setValue(state, `${object.path}.material.shader`, null));
    state.shader = name;
  } else {
    // The shader of all objects would go before that of one.
    if (state.shader) objects.forEach((object) => setValue(state, `${object.path}.material.shader`, object.shader));
    state.shader = null;
    setValue(state, `${path}.material.shader`, name);
  }
  ask();
}

function openScene(name, text = null) {
  const { size } = state;
  state = { ...emptyState(), scene: name, text, size, ledger: state.ledger };
  ask(0);
}

function play(on) {
  if (error && on) showError('');
  state.paused = !on;
  tell({ type: 'play', on });
  showStatus();
}

function step() {
  state.paused = true;
  tell({ type: 'step' });
  showStatus();
}

function reset() {
  showError('');
  ask(0);
}

function home() {
  state.sets = state.sets.filter((set) => !set.startsWith('camera.'));
  ask();
}

function save(name, bytes, type) {
  const a = make('a', { href: URL.createObjectURL(new Blob([bytes], { type })), download: name });
  a.click();
  setTimeout(() => URL.revokeObjectURL(a.href), 1000);
}

async function copy(text, button) {
  const label = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = 'Copied';
  } catch {
    button.textContent = 'Not allowed';
  }
  setTimeout(() => { button.textContent = label; }, 1500);
}

/// Opens files of the user's own: pictures are textures, anything else is a scene.
async function openFiles(files) {
  const pictures = files.filter((file) => /\.(png|jpe?g)$/i.test(file.name));
  const scene = files.find((file) => !pictures.includes(file));
  const stem = (file) => file.name.replace(/\.[^.]*$/, '');
  const faces = ['posx', 'negx', 'posy', 'negy', 'posz', 'negz'];
  const isCube = faces.every((face) => pictures.some((file) => stem(file) === face));
  let last = null;
  for (const file of pictures) {
    const face = isCube && faces.includes(stem(file));
    const name = face ? `cube/${stem(file)}` : stem(file);
    const bytes = new Uint8Array(await file.arrayBuffer());
    textures.set(name, bytes);
    worker?.postMessage({ type: 'texture', name, bytes });
    if (!face) last = name;
  }
  if (scene) {
    const bytes = new Uint8Array(await scene.arrayBuffer());
    openScene(scene.name, new TextDecoder('utf-8', { ignoreBOM: true }).decode(bytes));
  } else if (last !== null) {
    const chosen = objects.find((object) => object.path === element('object').value) ?? objects[0];
    const reads = chosen ? READS[chosen.shader] : [];
    if (!reads.includes('texture') && !reads.includes('height_map')) chooseShader('texture');
    changeLook(reads.includes('height_map') && !reads.includes('texture') ? 'height_map' : 'texture', JSON.stringify(last));
  } else if (isCube) {
    chooseShader('mirror');
  }
}

for (const [id, action] of Object.entries({
  play: () => play(state.paused), step, reset, home,
  apply: () => openScene(state.text === null ? 'scene.json' : state.scene, element('text').value),
  defaults: () => openScene(state.scene, state.text),
  'copy-command': (button) => copy(element('command').textContent, button),
  'copy-link': (button) => copy(location.href.replace(/#.*/, '') + link(), button),
  'save-png': () => worker.postMessage({ type: 'png' }),
  'save-positions': () => worker.postMessage({ type: 'positions' }),
  'save-scene': () => save(state.scene.replace(/(\.json)?$/, '.json'), sceneText(), 'application/json'),
})) element(id).addEventListener('click', (event) => action(event.currentTarget));

element('scene').addEventListener('change', ({ target }) => openScene(target.value, target.value in choices.scenes ? null : state.text));
element('size').addEventListener('change', ({ target }) => { state.size = target.value; ask(); });
element('shader').addEventListener('change', ({ target }) => chooseShader(target.value));
element('object').addEventListener('change', () => showLook());
element('allow-unstable').addEventListener('change', ({ target }) => { state.allow_unstable = target.checked; ask(); });
element('ledger-on').addEventListener('change', ({ target }) => { state.ledger = target.checked; ask(); });
element('file').addEventListener('change', ({ target }) => { openFiles([...target.files]); target.value = ''; });

addEventListener('hashchange', openLink);
addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const { target } = event;
  if (target.closest?.('textarea, select, input:not([type=range]):not([type=checkbox])')) return;
  // Space presses a button and ticks a box.
  if (event.key === ' ' && target.closest?.('button, input, summary')) return;
  const action = { p: () => play(state.paused), n: step, r: reset, ' ': home }[event.key.toLowerCase()];
  if (!action) return;
  event.preventDefault();
  action();
});
addEventListener('paste', (event) => {
  if (event.target.closest?.('textarea, input')) return;
  const files = [...event.clipboardData.files];
  const text = event.clipboardData.getData('text');
  if (files.length) openFiles(files);
  else if (text.trim()) openScene('pasted.json', text);
});
addEventListener('dragover', (event) => { event.preventDefault(); document.body.classList.add('dropping'); });
addEventListener('dragleave', (event) => { if (!event.relatedTarget) document.body.classList.remove('dropping'); });
addEventListener('drop', (event) => {
  event.preventDefault();
  document.body.classList.remove('dropping');
  openFiles([...event.dataTransfer.files]);
});

makeView(element('view'), () => camera, (changes) => { if (camera) change(changes); });
startWorker();
