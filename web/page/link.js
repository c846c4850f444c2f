// The state of the page, and links to it.
'use strict';

const element = (id) => document.getElementById(id);

/// What is shown. `sets` are `PATH=JSON`, as for `--set`.
function emptyState() {
  return {
    scene: 'sphere', text: null, patches: [], sets: [], shader: null, size: null, springs: null,
    allow_unstable: false, ledger: false, frame: null, paused: false,
  };
}

/// What the engine is asked for.
function requestOf(state) {
  const { frame, paused, size, ...request } = state;
  return { ...request, size: size ?? DEFAULT_SIZE };
}
const DEFAULT_SIZE = '640x500';

/// The state of a link, the part after `#`. Throws a text if it is none.
function parseLink(hash) {
  const state = emptyState();
  for (const part of hash.replace(/^#/, '').split('&').filter(Boolean)) {
    const at = part.indexOf('=');
    const name = at < 0 ? part : part.slice(0, at);
    const value = at < 0 ? null : decodeURIComponent(part.slice(at + 1));
    const read = LINK_PARTS[name];
    if (!read) throw `error: the link has an unknown part \`${name}\``;
    read(state, value);
  }
  return state;
}

const LINK_PARTS = {
  scene: (state, value) => { state.scene = value; },
  text: (state, value) => { state.text = value; },
  patch: (state, value) => { state.patches.push(value); },
  set: (state, value) => { state.sets.push(value); },
  shader: (state, value) => { state.shader = value; },
  size: (state, value) => { state.size = value; },
  springs: (state, value) => { state.springs = value; },
  frame: (state, value) => {
    if (!/^\d{1,9}$/.test(value ?? '')) throw `error: the frame of the link is \`${value}\` but must be a whole number`;
    state.frame = Number(value);
  },
  paused: (state) => { state.paused = true; },
  ledger: (state) => { state.ledger = true; },
  'allow-unstable': (state) => { state.allow_unstable = true; },
};

/// The link to `state`, with `#`.
function formatLink(state) {
  const parts = [];
  const put = (name, value) => parts.push(`${name}=${encode(value)}`);
  put('scene', state.scene);
  if (state.text !== null) put('text', state.text);
  if (state.frame !== null) put('frame', String(state.frame));
  if (state.paused) parts.push('paused');
  if (state.shader) put('shader', state.shader);
  if (state.size) put('size', state.size);
  if (state.springs) put('springs', state.springs);
  state.patches.forEach((patch) => put('patch', patch));
  state.sets.forEach((set) => put('set', set));
  if (state.allow_unstable) parts.push('allow-unstable');
  if (state.ledger) parts.push('ledger');
  return '#' + parts.join('&');
}

/// A value of a link; what needs no code stays readable.
function encode(value) {
  return encodeURIComponent(value).replace(/%(3D|2C|2F|3A|5B|5D)/g, decodeURIComponent);
}

/// Changes one value; `null` goes back to that of the file.
function setValue(state, path, value) {
  const at = state.sets.findIndex((set) => set.startsWith(`${path}=`));
  if (value === null) {
    if (at >= 0) state.sets.splice(at, 1);
    return;
  }
  const set = `${path}=${typeof value === 'string' ? value : JSON.stringify(value)}`;
  if (at >= 0) state.sets[at] = set;
  else state.sets.push(set);
}
