// Results in words, tables and histograms.

const element = (name, properties = {}) => Object.assign(document.createElement(name), properties);
const number = (value) => Number(value).toLocaleString('en', { maximumSignificantDigits: 4 });

const counted = (count, one, many = `${one}s`) => `${number(count)} ${count === 1 ? one : many}`;

/** What a label's certificate says, in words. */
export function certificateWords(label) {
  const { certificate, shape, name } = label;
  if (!certificate) return null;
  const [pieces, loops, cavities] = shape.betti;
  const same = `${counted(pieces, 'piece')}, ${counted(loops, 'loop')} and ${counted(cavities, 'cavity', 'cavities')}`;
  const says = {
    topology: `it has the shape's ${same}`,
    skeleton: 'so has the skeleton',
    enclosed: 'it lies within the shape',
    covered: 'its balls cover the shape up to the tolerance',
    stand_out: 'each branch stands out from the shape',
  };
  const failed = Object.entries(certificate)
    .filter(([, passed]) => passed === false)
    .map(([what]) => what);
  if (!certificate.passed) return `${name}: the certificate failed (${failed.join(', ')}). Do not use this result.`;
  const held = Object.keys(says)
    .filter((what) => certificate[what])
    .map((what) => says[what]);
  return `${name}: certified. Checked in this run: ${held.join('; ')}.`;
}

/** Rows of a table in CSV. */
export function readCsv(text) {
  const rows = [[]];
  for (const [, quoted, plain, end] of text.matchAll(/(?:"((?:[^"]|"")*)"|([^,\r\n]*))(,|\r?\n|$)/g)) {
    rows.at(-1).push(quoted === undefined ? plain : quoted.replaceAll('""', '"'));
    if (end === '') break;
    if (end !== ',') rows.push([]);
  }
  return rows.filter((row) => row.length > 1 || row[0] !== '');
}

const kMostRows = 200; // more are for a spreadsheet

export function tableOf(name, text) {
  const [head, ...rows] = readCsv(text);
  const part = element('details', { open: rows.length <= 20 });
  part.append(element('summary', { textContent: `${name} (${counted(rows.length, 'row')})` }));
  const scroll = element('div', { className: 'scroll', tabIndex: 0 });
  scroll.setAttribute('role', 'region');
  scroll.setAttribute('aria-label', name);
  const table = element('table');
  const top = table.createTHead().insertRow();
  head.forEach((title, i) => {
    const isNumber = Number.isFinite(Number(rows[0]?.[i] || 'none'));
    top.append(
      element('th', { scope: 'col', className: isNumber ? 'n' : '', textContent: title.replaceAll('_', ' ') }),
    );
  });
  const body = table.createTBody();
  for (const row of rows.slice(0, kMostRows)) {
    const line = body.insertRow();
    for (const cell of row) {
      const isNumber = cell !== '' && Number.isFinite(Number(cell));
      line.append(
        element('td', { textContent: isNumber ? number(cell) : cell, title: cell, className: isNumber ? 'n' : '' }),
      );
    }
  }
  scroll.append(table);
  part.append(scroll);
  if (rows.length > kMostRows) {
    part.append(element('p', { className: 'note', textContent: `The first ${kMostRows} rows; the file has all.` }));
  }
  return part;
}

const kBins = 32;

/** A histogram of `values`, as a figure. */
export function histogramOf(title, values, { least, greatest }, unit) {
  if (!(greatest > least)) return null;
  const bins = new Array(kBins).fill(0);
  let count = 0;
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    ++bins[Math.min(kBins - 1, Math.floor(((value - least) / (greatest - least)) * kBins))];
    ++count;
  }
  const most = Math.max(...bins);
  const figure = element('figure');
  figure.append(element('figcaption', { textContent: `${title} at ${counted(count, 'point')}` }));
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', `0 0 ${kBins} 100`);
  svg.setAttribute('preserveAspectRatio', 'none');
  svg.setAttribute('role', 'img');
  svg.setAttribute('aria-label', `${title}: from ${number(least)} to ${number(greatest)} ${unit}`);
  bins.forEach((bin, i) => {
    const bar = document.createElementNS(svg.namespaceURI, 'rect');
    const tall = (100 * bin) / most;
    for (const [name, value] of Object.entries({ x: i + 0.04, y: 100 - tall, width: 0.92, height: tall }))
      bar.setAttribute(name, value);
    svg.append(bar);
  });
  const axis = element('div', { className: 'axis' });
  for (const part of [0, 0.5, 1]) {
    axis.append(
      element('span', { textContent: `${number(least + part * (greatest - least))} ${part === 1 ? unit : ''}` }),
    );
  }
  figure.append(svg, axis);
  return figure;
}
