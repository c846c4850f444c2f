// What the page shows: the values of a scene, a picture with what is said of it, errors.
'use strict';

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
  ({ objects, values, textures: ownTextures } = answer);
  camera = {
    target: values['camera.target'], distance: values['camera.distance'],
    polar: values['camera.polar'], azimuth: values['camera.azimuth'],
  };
  controls.show(answer);
  showGauge(answer.gauge);
  const chosen = element('object').value;
  fill(element('object'), [['', '', 'all'], ...objects.map(({ path }) => path)]);
  element('object').value = objects.some(({ path }) => path === chosen) ? chosen : '';
  showLook();
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

/// Shows what the chosen object looks like.
function showLook() {
  const path = element('object').value;
  const object = objects.find((object) => object.path === path) ?? objects[0];
  if (!object) return;
  element('shader').value = object.shader;
  controls.showLook({ ...object, path }, ownTextures);
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
  showFacts(message);
  showRows(message.rows);
  if (state.paused) showAddress();
  showStatus();
}

/// Shows what is said of a picture.
function showFacts(message) {
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
}

function showRows(rows) {
  for (const [, time, kinetic, spring, gravitational, ...ledger] of rows) {
    plots.energy.add([time, kinetic, spring, gravitational]);
    if (ledger.length) plots.ledger.add([time, ...ledger]);
  }
  plots.energy.draw();
  if (state.ledger) plots.ledger.draw();
}
