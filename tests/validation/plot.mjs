// Overlay plots by gnuplot, as PNG into docs/images/validation.
import { execFileSync } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { ROOT } from './harness.mjs';

export const IMAGES = join(ROOT, 'docs/images/validation');

const WIDTH = 1000, HEIGHT = 560; // of one panel alone; of a grid, [pixel]
const SMALL_WIDTH = 620, SMALL_HEIGHT = 330;
const COLOURS = ['#0b5fa5', '#c4501b', '#2b8a3e', '#7b3fa0', '#8a6d00'];
const GREY = '#444444';

export function gnuplotVersion() {
  try {
    return execFileSync('gnuplot', ['--version'], { encoding: 'utf8' }).trim();
  } catch {
    return null;
  }
}

/// What gnuplot reads: text in quotes, without its own markup.
const quoted = (text) => `"${String(text).replace(/["\\]/g, '')}"`;

function block(curve) {
  const rows = curve.x.map((x, i) => (curve.low ? [x, curve.low[i], curve.high[i]] : [x, curve.y[i]]));
  return rows.filter((row) => row.every(Number.isFinite)).map((row) => row.join(' ')).join('\n');
}

/// How a curve is drawn: 'line' (ours), 'dashed' (theory), 'points' (measured), 'band' (spread of measurements).
function style(curve, colour) {
  switch (curve.style) {
  case 'points': return `with points pt 6 ps 0.9 lw 1.4 lc rgb "${curve.colour ?? GREY}"`;
  case 'thin': return `with lines lw 1.2 lc rgb "${curve.colour ?? GREY}"`;
  case 'dashed': return `with lines dt 2 lw 1.8 lc rgb "${curve.colour ?? GREY}"`;
  case 'band': return `with filledcurves fs solid 0.35 noborder lc rgb "${curve.colour ?? '#999999'}"`;
  default: return `with lines lw 2 lc rgb "${curve.colour ?? colour}"`;
  }
}

function panelScript(panel, index) {
  const range = (axis, limits) => `set ${axis}range [${limits ? limits.map((v) => v ?? '*').join(':') : '*:*'}]`;
  let text = `set title ${quoted(panel.title ?? '')}\nset xlabel ${quoted(panel.x)}\nset ylabel ${quoted(panel.y)}\n` +
    `${range('x', panel.xrange)}\n${range('y', panel.yrange)}\nset key ${panel.key ?? 'top right'}\n${panel.log ? 'set' : 'unset'} logscale y\n`;
  let colour = 0;
  const drawn = panel.curves.map((curve, k) => {
    text += `$d${index}_${k} << EOD\n${block(curve)}\nEOD\n`;
    const own = curve.style === undefined ? COLOURS[colour++ % COLOURS.length] : undefined;
    return `$d${index}_${k} using ${curve.low ? '1:2:3' : '1:2'} ${style(curve, own)} ` +
      (curve.label ? `title ${quoted(curve.label)}` : 'notitle');
  });
  return `${text}plot ${drawn.join(', \\\n  ')}\n`;
}

/// @param plot  { panels: [{ x, y, title, curves: [{ label, x, y | low, high, style, colour }], xrange, yrange, key,
///              log: y in decades }], columns }
export function draw(name, plot) {
  mkdirSync(IMAGES, { recursive: true });
  const count = plot.panels.length, columns = plot.columns ?? (count > 1 ? 2 : 1), rows = Math.ceil(count / columns);
  const size = count === 1 ? [WIDTH, HEIGHT] : [SMALL_WIDTH * columns, SMALL_HEIGHT * rows];
  const script = `set encoding utf8\nset terminal pngcairo noenhanced size ${size.join(',')} font "Sans,${count > 1 ? 10 : 12}"\n` +
    `set output ${quoted(join(IMAGES, `${name}.png`))}\nset autoscale xfix\nset grid lc rgb "#dddddd"\nset border lc rgb "#333333"\n` +
    (count > 1 ? `set multiplot layout ${rows},${columns}\n` : '') + plot.panels.map(panelScript).join('') +
    (count > 1 ? 'unset multiplot\n' : '');
  execFileSync('gnuplot', ['-'], { input: script, stdio: ['pipe', 'inherit', 'inherit'] });
}
