// Runs the engine of the live page in Node: `node node.js PAGE SCENE...` prints the hashes of all frames and pictures.
'use strict';

const { engine } = require('./engine.js');

const [page, ...scenes] = process.argv.slice(2);
const wasm_bindgen = engine(page);

const FRAMES = 90;
const SIZE = '320x250';

const shaders = JSON.parse(wasm_bindgen.Page.choices()).keys['material.shader'].map(([name]) => name);
const found = {};
for (const scene of scenes) {
  const page = new wasm_bindgen.Page();
  const load = (request) => page.load(JSON.stringify({ scene, size: SIZE, ...request }));
  load({});
  const states = [page.state_hash()];
  for (let frame = 0; frame < FRAMES; frame += 1) {
    page.advance();
    states.push(page.state_hash());
  }
  const pictures = {};
  for (const shader of shaders) {
    load({ shader });
    page.draw();
    pictures[shader] = page.picture_hash();
  }
  found[scene] = { states, pictures };
}
process.stdout.write(JSON.stringify(found));
