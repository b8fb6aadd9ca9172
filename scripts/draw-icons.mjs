/**
 * Draws the page's icon, a landmarked triangle, as SVG and as the PNGs that an installed page needs. Run it by `npm run icons` when the
 * drawing has changed.
 */
import { writeFileSync } from 'node:fs';
import { crc32, deflateSync } from 'node:zlib';

const FOLDER = new URL('../www/public/', import.meta.url);

/** The side of the square in which the drawing lies. */
const SIDE = 32;
const TRIANGLE = { points: [[16, 3], [29, 26], [3, 26]], colour: '#2f6f8f' };
const DOTS = [
  { centre: [16, 3.6], radius: 3, colour: '#c8402f' },
  { centre: [4, 26], radius: 3, colour: '#3556c0' },
  { centre: [28, 26], radius: 3, colour: '#c8402f' },
];
/** The ground of maskable icons: systems cut these to shapes of their own, of which only the middle 80 % is certain to stay. */
const GROUND = '#f4f2ee';

const ICONS = [
  { file: 'icon-192.png', size: 192, share: 1, ground: null },
  { file: 'icon-512.png', size: 512, share: 1, ground: null },
  { file: 'icon-maskable-512.png', size: 512, share: 0.6, ground: GROUND },
];

/** The number of samples along each side of a pixel. */
const SAMPLES = 4;

function svg() {
  const triangle = `<path d="M${TRIANGLE.points.map((point) => point.join(' ')).join(' ')}Z" fill="${TRIANGLE.colour}"/>`;
  const dots = DOTS.map(({ centre: [x, y], radius, colour }) => `<circle cx="${x}" cy="${y}" r="${radius}" fill="${colour}"/>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${SIDE} ${SIDE}">${triangle}${dots.join('')}</svg>\n`;
}

/** Whether a point lies in the triangle, whose corners are clockwise on the screen. */
function isInTriangle(x, y) {
  return TRIANGLE.points.every(([ax, ay], corner) => {
    const [bx, by] = TRIANGLE.points[(corner + 1) % 3];
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0;
  });
}

/** The colour at a point of the drawing; `null` outside of it. */
function colourAt(x, y) {
  const dot = DOTS.findLast(({ centre, radius }) => Math.hypot(x - centre[0], y - centre[1]) <= radius);
  return dot?.colour ?? (isInTriangle(x, y) ? TRIANGLE.colour : null);
}

function channels(colour) {
  return [1, 3, 5].map((start) => Number.parseInt(colour.slice(start, start + 2), 16));
}

/** The red, green, blue and opacity of a pixel, from 0 to 255: the mean of its samples. */
function pixel(column, row, { size, share, ground }) {
  const sums = [0, 0, 0, 0];
  for (let sample = 0; sample < SAMPLES ** 2; sample++) {
    const across = (column + ((sample % SAMPLES) + 0.5) / SAMPLES) / size;
    const down = (row + (Math.floor(sample / SAMPLES) + 0.5) / SAMPLES) / size;
    const colour = colourAt(SIDE * ((across - 0.5) / share + 0.5), SIDE * ((down - 0.5) / share + 0.5)) ?? ground;
    if (colour !== null) {
      channels(colour).forEach((value, channel) => (sums[channel] += value));
      sums[3]++;
    }
  }
  const drawn = Math.max(1, sums[3]);
  return [...sums.slice(0, 3).map((sum) => Math.round(sum / drawn)), Math.round((255 * sums[3]) / SAMPLES ** 2)];
}

function chunk(type, data) {
  const bytes = Buffer.alloc(data.length + 12);
  bytes.writeUInt32BE(data.length, 0);
  bytes.write(type, 4, 'latin1');
  data.copy(bytes, 8);
  bytes.writeUInt32BE(crc32(bytes.subarray(4, data.length + 8)), data.length + 8);
  return bytes;
}

function png(icon) {
  const { size } = icon;
  const rows = Array.from({ length: size }, (_, row) => [0, ...Array.from({ length: size }, (_, column) => pixel(column, row, icon)).flat()]);
  const head = Buffer.alloc(13);
  head.writeUInt32BE(size, 0);
  head.writeUInt32BE(size, 4);
  // The format: eight bits a channel, with opacity.
  head.set([8, 6], 8);
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  const data = deflateSync(Buffer.from(rows.flat()), { level: 9 });
  return Buffer.concat([signature, chunk('IHDR', head), chunk('IDAT', data), chunk('IEND', Buffer.alloc(0))]);
}

writeFileSync(new URL('icon.svg', FOLDER), svg());
for (const icon of ICONS) {
  writeFileSync(new URL(icon.file, FOLDER), png(icon));
}
