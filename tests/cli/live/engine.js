// The engine of the live page PAGE, as Node runs it.
'use strict';

const { readFileSync } = require('node:fs');
const { gunzipSync } = require('node:zlib');

exports.engine = (page) => {
  const html = readFileSync(page, 'utf8');
  const script = (id) => html.split(`id="${id}">`)[1].split('</script>')[0];
  const wasm = gunzipSync(Buffer.from(script('wasm'), 'base64'));
  const wasm_bindgen = new Function(`${script('worker')}\nreturn wasm_bindgen;`)();
  wasm_bindgen.initSync({ module: wasm });
  return wasm_bindgen;
};
