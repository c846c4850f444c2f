// Plots of numbers over time, drawn anew with each picture.
'use strict';

/// Most points of a line that are drawn; more are thinned out.
const MOST_POINTS = 600;

/// A plot of several lines over time. `names` has a name for each line.
class Plot {
  constructor(figure, names) {
    this.canvas = figure.querySelector('canvas');
    this.names = names;
    this.rows = [];
    const legend = figure.querySelector('.legend');
    legend.replaceChildren(...names.map((name, i) => {
      const item = document.createElement('span');
      item.className = `line${i}`;
      item.textContent = name;
      return item;
    }));
  }

  clear() {
    this.rows = [];
  }

  /// Adds a row: the time, then a number for each line.
  add(row) {
    this.rows.push(row);
    if (this.rows.length > 2 * MOST_POINTS) this.rows = this.rows.filter((_, i) => i % 2 === 0);
  }

  draw() {
    const { canvas, rows } = this;
    const scale = devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (!width) return;
    canvas.width = width * scale;
    canvas.height = height * scale;
    const paper = canvas.getContext('2d');
    paper.scale(scale, scale);
    const style = getComputedStyle(canvas);
    paper.font = '11px system-ui, sans-serif';
    paper.fillStyle = style.getPropertyValue('--soft');
    if (rows.length < 2) {
      paper.fillText('no frames yet', 8, 16);
      return;
    }
    const numbers = rows.flatMap((row) => row.slice(1)).filter(Number.isFinite);
    const [low, high] = numbers.reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [0, 0]);
    const extent = high - low || 1;
    const [from, to] = [rows[0][0], rows.at(-1)[0]];
    const x = (time) => 2 + (width - 4) * (time - from) / (to - from || 1);
    const y = (value) => 14 + (height - 28) * (high - value) / extent;
    paper.strokeStyle = style.getPropertyValue('--line');
    paper.beginPath();
    paper.moveTo(0, y(0));
    paper.lineTo(width, y(0));
    paper.stroke();
    this.names.forEach((_, i) => {
      paper.strokeStyle = style.getPropertyValue(`--line${i}`);
      paper.lineWidth = 1.5;
      paper.beginPath();
      rows.forEach((row, at) => paper[at ? 'lineTo' : 'moveTo'](x(row[0]), y(row[i + 1])));
      paper.stroke();
    });
    paper.fillText(`${short(high)} J`, 4, 11);
    paper.fillText(`${short(low)} J`, 4, height - 3);
    const end = `${short(to)} s`;
    paper.fillText(end, width - paper.measureText(end).width - 4, height - 3);
  }
}

/// A number with three digits.
function short(value) {
  if (!Number.isFinite(value)) return String(value);
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-3 ? value.toExponential(2) : String(Number(value.toPrecision(3)));
}
