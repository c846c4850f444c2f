// `node everywhere.js PAGE everywhere.txt` prints the lines of the file with the hashes that the engine of the live page computes.
'use strict';

const { readFileSync } = require('node:fs');
const { engine } = require('./engine.js');

const [path, file] = process.argv.slice(2);
const { Page } = engine(path);

// The picture hashes are of this frame and size.
const FRAME = 10;
const SIZE = '160x125';

const loaded = (request) => {
  const page = new Page();
  page.load(JSON.stringify(request));
  return page;
};

// The last page, with what it was loaded with and its frame: lines of one run follow each other.
let last = { key: '', page: null, frame: 0 };
const at = (frame, request) => {
  const key = JSON.stringify(request);
  if (last.key !== key || last.frame > frame) last = { key, page: loaded(request), frame: 0 };
  for (; last.frame < frame; last.frame += 1) last.page.advance();
  return last.page;
};

const state = (scene, words) => at(Number(words.pop()), { scene, sets: words }).state_hash();

const picture = (scene, [option, value]) => {
  const look = option === '--shader' ? { shader: value } : { sets: [`render.samples=${value}`] };
  const page = at(FRAME, { scene, size: SIZE, ...look });
  page.draw();
  return page.picture_hash();
};

const KINDS = { state, picture };
for (const line of readFileSync(file, 'utf8').trimEnd().split('\n')) {
  const words = line.split(' ').slice(0, -1);
  const [kind, scene, ...rest] = words;
  process.stdout.write(`${words.join(' ')} ${KINDS[kind](scene, rest)}\n`);
}
