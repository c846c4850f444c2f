//! What the page does when it is clicked: sorts its table, and opens a case. Without it all is there to be read.

/// The style of what only this page has.
pub(super) const STYLE: &str = "<style>\
.tally{display:flex;flex-wrap:wrap;gap:.5rem;padding:0;list-style:none}.tally li{background:var(--shade);\
border-radius:6px;padding:.4rem .8rem}.tally b{font-size:1.3rem;display:block}\
.sheet{font-size:.85rem}.sheet td{padding:3px;border:0;vertical-align:middle}.sheet th{color:var(--soft);\
font-weight:normal;border:0;text-align:center}.sheet th[scope=row]{text-align:right}\
.sheet img{width:8rem;max-width:none;border-radius:4px}.tile{display:block;text-decoration:none}\
.groups{display:flex;flex-wrap:wrap;gap:0 2.5rem}.groups>div{max-width:100%}.groups h3{margin-bottom:0}\
.flow{display:flex;flex-wrap:wrap;gap:.6rem}.flow figure{margin:0}\
.none{width:8rem;min-height:4rem;display:grid;place-items:center;border:1px dashed var(--line);border-radius:4px;\
color:var(--b);padding:.3rem;text-align:center;white-space:normal}\
th button{all:unset;cursor:pointer;font-weight:bold}th button:focus-visible{outline:2px solid var(--a)}\
th[aria-sort=ascending] button::after{content:' \\25b2'}th[aria-sort=descending] button::after{content:' \\25bc'}\
.cases{max-height:40rem;overflow:auto}.cases thead th{position:sticky;top:0;background:var(--paper)}\
.cases tr.bad td{color:var(--b)}.cases td:last-child{text-align:left}\
.tile:focus-visible img,.tile:hover img,.tile:hover .none{outline:2px solid var(--a)}\
dialog{max-width:min(46rem,94vw);color:var(--ink);background:var(--paper);border:1px solid var(--line);\
border-radius:8px}dialog::backdrop{background:#0008}dialog h2{margin-top:0}dialog img{max-width:100%;image-rendering:auto}\
dialog dl{display:grid;grid-template-columns:auto 1fr;gap:.15rem 1rem}dialog dd{margin:0}\
dialog pre{white-space:pre-wrap}dialog button{font:inherit;padding:.2rem .9rem}\
.plot{max-width:34rem}</style>\n";

/// The dialog of a case, and the script.
pub(super) const SCRIPT: &str = r##"<dialog aria-labelledby="case-name"><h2 id="case-name"></h2><div id="case-picture"></div><dl></dl>
<p>Command:</p><pre></pre><form method="dialog"><button>Close</button></form></dialog>
<script>
const table = document.querySelector('.cases table');
const heads = [...table.tHead.rows[0].cells];
const key = (row, column) => {
  const cell = row.cells[column], value = cell.dataset.v ?? cell.textContent;
  return value === '' ? null : isNaN(value) ? value : Number(value);
};
const before = (a, b) => a === b ? 0 : a === null ? 1 : b === null ? -1
  : typeof a === typeof b ? (a < b ? -1 : 1) : typeof a === 'number' ? -1 : 1;
heads.forEach((head, column) => head.querySelector('button').addEventListener('click', () => {
  const down = head.getAttribute('aria-sort') === 'ascending';
  const rows = [...table.tBodies[0].rows].map(row => [key(row, column), row]);
  rows.sort(([a], [b]) => a === null || b === null ? before(a, b) : down ? before(b, a) : before(a, b));
  heads.forEach(other => other.removeAttribute('aria-sort'));
  head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
  table.tBodies[0].append(...rows.map(([, row]) => row));
}));
const dialog = document.querySelector('dialog');
const show = number => {
  const row = document.getElementById('case-' + number);
  const tile = document.querySelector(`.tile[data-case="${number}"] img`);
  dialog.querySelector('h2').textContent = 'Case ' + number;
  document.getElementById('case-picture').replaceChildren(...(tile ? [tile.cloneNode()] : []));
  dialog.querySelector('dl').replaceChildren(...heads.slice(1).flatMap((head, i) => {
    const term = document.createElement('dt'), text = document.createElement('dd');
    term.textContent = head.textContent;
    text.textContent = row.cells[i + 1].dataset.v ?? row.cells[i + 1].textContent;
    return text.textContent ? [term, text] : [];
  }));
  dialog.querySelector('pre').textContent = row.dataset.command;
  dialog.showModal();
};
document.addEventListener('click', event => {
  const link = event.target.closest('[data-case]');
  if (link) { event.preventDefault(); show(link.dataset.case); }
  else if (event.target === dialog) dialog.close();
});
</script>
"##;
