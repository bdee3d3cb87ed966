// Brings the figures of a report to life: where a figure's lines came with it, a chart takes the place of its picture on
// the screen. On paper, and without this script, the pictures stand.
import { Plot } from '../lib/charts/plot';
import { chineseOf } from '../lib/i18n/said';
import type { Language } from '../lib/i18n/words.svelte';
import { columnsOf, linesOf, marksOf, markNames, type Chart, type ReportData } from './data';

const HEIGHT = 240;
const INK = '#55616e';
const GRID = '#d5dbe1';

const data = JSON.parse(document.getElementById('lukou-data')!.textContent!) as ReportData;
const choices = [...document.querySelectorAll<HTMLInputElement>('input[name="language"]')];
const language = () => (choices.find(({ checked }) => checked)?.value ?? 'en') as Language;

let plots: Plot[] = [];

function heading(tag: string, className: string, text: string): HTMLElement {
  const element = document.createElement(tag);
  element.className = className;
  element.textContent = text;
  return element;
}

function drawChart(chart: Chart, into: HTMLElement): void {
  const words = language();
  const box = document.createElement('div');
  box.setAttribute('role', 'group');
  box.setAttribute('aria-label', chart.title[words]);
  const panel = document.createElement('div');
  panel.append(heading('h3', '', chart.title[words]), heading('p', 'names', chart.subtitle[words]), box);
  const names = markNames(chart, words);
  if (names.length > 0) panel.append(heading('p', 'names', names.map((name) => `| ${name}`).join('  ')));
  into.append(panel);
  plots.push(
    new Plot(
      box,
      {
        height: HEIGHT,
        timeLabel: chart.x[words],
        xLabel: chart.x[words],
        yLabel: chart.y[words],
        fromZero: chart.yMin === 0,
        lines: linesOf(chart, words),
        ink: INK,
        grid: GRID,
        marks: () => marksOf(chart),
        // Those over the same axis have a common crosshair.
        group: chart.x.en,
      },
      columnsOf(chart),
    ),
  );
  box.tabIndex = 0;
  const plot = plots[plots.length - 1];
  box.onkeydown = (event) => {
    if (plot.key(event.key)) event.preventDefault();
  };
}

function draw(): void {
  plots.forEach((plot) => plot.destroy());
  plots = [];
  const words = language();
  document.documentElement.lang = words === 'zh' ? 'zh-CN' : 'en';
  document.title = data.title[words];
  for (const figure of document.querySelectorAll<HTMLElement>('figure[data-figure]')) {
    const charts = data.charts[figure.dataset.figure!];
    const into = figure.querySelector<HTMLElement>('.charts');
    if (charts === undefined || into === null) continue;
    into.replaceChildren();
    figure.classList.add('drawn');
    charts.forEach((chart) => drawChart(chart, into));
  }
}

/** Sentences of the scenario's check come in English: the console's table knows them in Chinese. */
function translate(): void {
  for (const sentence of document.querySelectorAll<HTMLElement>('.said')) {
    const chinese = heading('span', 'zh', chineseOf(sentence.textContent!));
    chinese.lang = 'zh-CN';
    sentence.classList.add('en');
    sentence.after(chinese);
  }
}

translate();
choices.forEach((choice) => choice.addEventListener('change', draw));
draw();
