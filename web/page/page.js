// The page's state, the worker, and what the user can order.
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
let ownTextures = []; // the names of the user's own textures
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
    const ending = { png: 'png', positions: 'bin', state: 'state' }[what];
    save(`${name}-${frame}.${ending}`, bytes, what === 'png' ? 'image/png' : 'application/octet-stream');
  },
};

/// Asks the engine for what the state says. `frame` is where to simulate to; without it, the frame that is shown.
function ask(frame = null) {
  showError('');
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
  knowAddress();
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

/// Shows an error and stops; the picture stays, and what was said of it.
function stop(text) {
  showError(text);
  if (moment) showFacts(moment);
  state.paused = true;
  showStatus();
}

/// The link to the moment that is shown.
function link() {
  return formatLink({ ...state, frame: state.paused ? moment?.frame ?? null : null });
}

/// Shortest time between two changes of the address, in ms: browsers drop changes, links too, beyond 20 a second.
const ADDRESS_PAUSE = 250;
let address = { known: '', since: -Infinity, timer: 0 };

/// Makes the address the link to what is shown, at once or soon.
function showAddress() {
  clearTimeout(address.timer);
  // A link that was just followed is not heard of yet, and must not be lost.
  if (location.hash === link() || location.hash !== address.known) return;
  const wait = address.since + ADDRESS_PAUSE - performance.now();
  if (wait > 0) {
    address.timer = setTimeout(showAddress, wait);
    return;
  }
  history.replaceState(null, '', link());
  knowAddress();
  address.since = performance.now();
}

function knowAddress() {
  clearTimeout(address.timer);
  address.known = location.hash;
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
