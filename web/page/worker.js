// The worker: moves and draws the cloth. Messages come from `page.js`, pictures go there.
'use strict';

/// How long it works before it looks for messages, in ms.
const SLICE = 25;
let page; // the engine
let asked = null; // the newest request that was not loaded yet
let goal = 0; // the frame to simulate to before a picture is drawn
let missed = 0; // the goal that was given up when the cloth blew up
let playing = false;
let failure = ''; // how the cloth blew up
let id = 0; // the number of the last order of the page that was carried out
let stale = false; // whether the picture that the page has is not that of the state
let waiting = 0; // how many pictures the page has not shown yet
let fps = 90;
let rows = []; // a row for each frame since the last picture
let scheduled = false;
// When the page last moved on, how many frames are due, and what the last second had.
let clock = { since: 0, due: 0, history: [], simulate: 0 };

const actions = {
  async start({ wasm }) {
    await wasm_bindgen({ module_or_path: wasm });
    page = new wasm_bindgen.Page();
    postMessage({ type: 'ready', choices: JSON.parse(wasm_bindgen.Page.choices()) });
  },
  load(message) { asked = message; },
  play({ on, id: order }) {
    id = order;
    playing = on && !failure;
    stale = true;
    restartClock();
    if (on && failure) postMessage({ type: 'failed', text: failure });
  },
  step({ id: order }) {
    id = order;
    playing = false;
    stale = true;
    if (failure) postMessage({ type: 'failed', text: failure });
    else goal = Math.max(goal, page.frame()) + 1;
  },
  shown() { waiting -= 1; },
  texture({ name, bytes }) { page.add_texture(name, bytes); postMessage({ type: 'texture', name }); },
  png() { give('png', page.png()); },
  positions() { give('positions', page.positions()); },
  state() { give('state', page.state()); },
};

onmessage = ({ data }) => guarded(() => actions[data.type](data));

/// Does `work`. An error of the engine is a text, and all stays as it was; anything else is a fault after which the
/// engine cannot be used.
async function guarded(work) {
  try {
    await work();
    schedule();
  } catch (error) {
    playing = false;
    if (typeof error === 'string') {
      postMessage({ type: 'failed', text: error });
      schedule();
    } else {
      postMessage({ type: 'broken', text: `the engine stopped: ${error.message ?? error}` });
    }
  }
}

function give(what, bytes) {
  postMessage({ type: 'file', what, bytes, frame: page.frame() }, [bytes.buffer]);
}

function begin() {
  failure = '';
  rows = [];
  restartClock();
  postMessage({ type: 'begin' });
  rows.push(page.row());
}

function restartClock() {
  clock = { since: performance.now(), due: 0, history: [], simulate: 0 };
}

function schedule(wait = 0) {
  if (scheduled || !page) return;
  scheduled = true;
  setTimeout(() => { scheduled = false; guarded(turn); }, wait);
}

/// One turn: loads, catches up, plays or draws.
function turn() {
  if (asked) return load();
  if (page.frame() < goal) return catchUp();
  // One picture may wait while the next is made; the page says when it has shown one.
  if (waiting > 1) return;
  if (playing) return play();
  if (stale) draw();
}

function load() {
  const { request, frame, play, id: order } = asked;
  asked = null;
  id = Math.max(id, order);
  const before = Math.max(page.frame(), goal, missed);
  missed = 0;
  let answer;
  try {
    answer = JSON.parse(page.load(JSON.stringify(request)));
  } catch (error) {
    if (typeof error !== 'string') throw error;
    playing = false;
    postMessage({ type: 'failed', text: error });
    return;
  }
  fps = answer.values['sim.fps'];
  const wanted = frame ?? before;
  if (answer.anew) begin();
  else if (wanted < page.frame() || failure) { page.reset(); begin(); }
  goal = wanted;
  playing = play;
  stale = true;
  restartClock();
  postMessage({ type: 'loaded', answer });
  schedule();
}

/// Moves on by a frame; false, after a message, if the cloth blew up.
function advance() {
  if (failure) return false;
  try {
    page.advance();
  } catch (error) {
    if (typeof error !== 'string') throw error;
    failure = error;
    playing = false;
    missed = goal;
    goal = page.frame();
    stale = true;
    postMessage({ type: 'failed', text: error });
    return false;
  }
  rows.push(page.row());
  return true;
}

function catchUp() {
  const started = performance.now();
  while (page.frame() < goal && performance.now() - started < SLICE) {
    if (!advance()) return;
  }
  stale = true;
  restartClock();
  if (page.frame() < goal) postMessage({ type: 'progress', frame: page.frame(), goal });
  schedule();
}

/// Simulates the frames that are due, as far as there is time, and draws. No frame is skipped: what there is no time
/// for makes the motion slower.
function play() {
  const now = performance.now();
  clock.due += (now - clock.since) * fps / 1000;
  clock.since = now;
  if (clock.due < 1) return schedule(1);
  let made = 0;
  while (made + 1 <= clock.due && performance.now() - now < SLICE) {
    if (!advance()) return;
    made += 1;
  }
  clock.due = Math.min(clock.due - made, 1);
  clock.simulate = (performance.now() - now) / made;
  clock.history.push([now, made]);
  clock.history = clock.history.filter(([time]) => now - time < 1000);
  goal = page.frame();
  draw();
}

/// How fast the motion is, as a share of real time, and how many pictures there are in a second.
function speed() {
  const { history, since } = clock;
  if (!playing || history.length < 3) return {};
  const seconds = (since - history[0][0]) / 1000;
  const frames = history.slice(1).reduce((sum, [, made]) => sum + made, 0);
  return { speed: frames / fps / seconds, pictures: (history.length - 1) / seconds };
}

function draw() {
  const started = performance.now();
  const pixels = page.draw();
  const drawn = performance.now() - started;
  stale = false;
  waiting += 1;
  postMessage({
    type: 'picture', pixels, width: page.width(), height: page.height(), frame: page.frame(), id,
    state: page.state_hash(), picture: page.picture_hash(), stretch: page.stretch(), command: page.command(),
    rows: rows.splice(0), simulate: clock.simulate, draw: drawn, ...speed(),
  }, [pixels.buffer]);
}
