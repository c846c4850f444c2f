// Buttons, lists, keys and drops; then the engine starts.
'use strict';

for (const [id, action] of Object.entries({
  play: () => play(state.paused), step, reset, home,
  apply: () => openScene(state.text === null ? 'scene.json' : state.scene, element('text').value),
  defaults: () => openScene(state.scene, state.text),
  'copy-command': (button) => copy(element('command').textContent, button),
  'copy-link': (button) => copy(location.href.replace(/#.*/, '') + link(), button),
  'save-png': () => worker.postMessage({ type: 'png' }),
  'save-positions': () => worker.postMessage({ type: 'positions' }),
  'save-state': () => worker.postMessage({ type: 'state' }),
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
