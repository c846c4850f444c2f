// Files of the user's own, and files to take away.
'use strict';

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

const FACES = ['posx', 'negx', 'posy', 'negy', 'posz', 'negz'];
const faces = new Map(); // of the cube map that is being dropped, by name

/// Takes a face of a cube map. The six may come together or one after the other; with the last one, all are used.
function takeFace(name, bytes) {
  faces.set(name, bytes);
  const missing = FACES.filter((face) => !faces.has(face));
  const told = missing.length ? `${6 - missing.length} of 6 faces of a cube map; still missing: ${missing.join(', ')}` : '';
  element('faces').textContent = told;
  if (missing.length) return false;
  for (const [face, picture] of faces) setTexture(`cube/${face}`, picture);
  return true;
}

function setTexture(name, bytes) {
  textures.set(name, bytes);
  worker?.postMessage({ type: 'texture', name, bytes });
}

/// Opens files of the user's own: pictures are textures, anything else is a scene.
async function openFiles(files) {
  const pictures = files.filter((file) => /\.(png|jpe?g)$/i.test(file.name));
  const scene = files.find((file) => !pictures.includes(file));
  const stem = (file) => file.name.replace(/\.[^.]*$/, '');
  let isCube = false;
  let last = null;
  for (const file of pictures) {
    const name = stem(file);
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (FACES.includes(name)) {
      isCube = takeFace(name, bytes);
    } else {
      setTexture(name, bytes);
      last = name;
    }
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
