/**
 * The time of a frame while two meshes of 100,000 triangles each are turned, compared with a bare draw of the same triangles on a canvas of
 * the same size, with only positions, normals and one light.
 */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { SETTLED } from './canvas.ts';
import { upload } from './own-files.ts';
import { fail, open } from './page.ts';

/** The rows and columns of a ball; it has twice their product of triangles, except at the poles. */
const ROWS = 224;

/** A ball with waves on it, as OBJ. */
function wavy(waves: number): string {
  const lines: string[] = ['v 0 0 1'];
  for (let row = 1; row < ROWS; row += 1) {
    for (let column = 0; column < ROWS; column += 1) {
      const [polar, round] = [(Math.PI * row) / ROWS, (2 * Math.PI * column) / ROWS];
      const out = 1 + 0.15 * Math.sin(waves * round) * Math.sin(polar) ** 2;
      lines.push(`v ${out * Math.sin(polar) * Math.cos(round)} ${out * Math.sin(polar) * Math.sin(round)} ${out * Math.cos(polar)}`);
    }
  }
  lines.push('v 0 0 -1');
  const at = (row: number, column: number): number => (row === 0 ? 1 : row === ROWS ? 2 + (ROWS - 1) * ROWS : 2 + (row - 1) * ROWS + (column % ROWS));
  for (let row = 0; row < ROWS; row += 1) {
    for (let column = 0; column < ROWS; column += 1) {
      if (row > 0) {
        lines.push(`f ${at(row, column)} ${at(row + 1, column)} ${at(row, column + 1)}`);
      }
      if (row < ROWS - 1) {
        lines.push(`f ${at(row, column + 1)} ${at(row + 1, column)} ${at(row + 1, column + 1)}`);
      }
    }
  }
  return lines.join('\n');
}

/** The median of some values. */
function median(values: readonly number[]): number {
  return values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)] ?? fail('no values');
}

/** The time between frames while the mouse drags in the first view, in ms. */
async function turned(page: Page): Promise<number> {
  const box = (await page.locator('#view-source').boundingBox()) ?? fail('no view');
  const times = page.evaluate(
    () =>
      new Promise<number[]>((resolve) => {
        const at: number[] = [];
        const frame = (now: number): void => {
          at.push(now);
          if (at.length < 90) {
            requestAnimationFrame(frame);
          } else {
            resolve(at.slice(1).map((time, k) => time - (at[k] ?? time)));
          }
        };
        requestAnimationFrame(frame);
      }),
  );
  await page.mouse.move(box.x + 8, box.y + box.height - 30);
  await page.mouse.down();
  const state = { isOver: false };
  void times.then(() => {
    state.isOver = true;
  });
  for (let k = 1; !state.isOver; k += 1) {
    await page.mouse.move(box.x + 8 + 100 * Math.sin(k / 20) ** 2, box.y + box.height - 30);
  }
  await page.mouse.up();
  return median((await times).slice(10));
}

/** The same for a bare draw of such balls, side by side. */
async function bare(page: Page, size: { readonly width: number; readonly height: number }): Promise<number> {
  await page.setContent(`<canvas width="${size.width}" height="${size.height}"></canvas>`);
  return median(
    await page.evaluate(async (rows) => {
      const gl = document.querySelector('canvas')?.getContext('webgl2', { antialias: true });
      if (!gl) {
        return [];
      }
      const program = gl.createProgram();
      for (const [kind, source] of [
        [gl.VERTEX_SHADER, '#version 300 es\nin vec3 p;in vec3 n;uniform float t;out vec3 m;void main(){float c=cos(t),s=sin(t);mat3 r=mat3(c,0,s,0,1,0,-s,0,c);m=r*n;vec3 q=r*p;gl_Position=vec4(q.xy*0.8,q.z*0.1,1);}'],
        [gl.FRAGMENT_SHADER, '#version 300 es\nprecision highp float;in vec3 m;out vec4 o;void main(){o=vec4(vec3(0.2+0.8*max(dot(normalize(m),vec3(0.6,0.48,0.64)),0.0)),1);}'],
      ] as const) {
        const shader = gl.createShader(kind);
        if (shader !== null) {
          gl.shaderSource(shader, source);
          gl.compileShader(shader);
          gl.attachShader(program, shader);
        }
      }
      gl.linkProgram(program);
      gl.useProgram(program);
      const points: number[] = [];
      const corners: number[] = [];
      for (let row = 0; row <= rows; row += 1) {
        for (let column = 0; column <= rows; column += 1) {
          const [polar, round] = [(Math.PI * row) / rows, (2 * Math.PI * column) / rows];
          const p = [Math.sin(polar) * Math.cos(round), Math.sin(polar) * Math.sin(round), Math.cos(polar)];
          points.push(...p, ...p);
          if (row < rows && column < rows) {
            const at = row * (rows + 1) + column;
            corners.push(at, at + rows + 1, at + 1, at + 1, at + rows + 1, at + rows + 2);
          }
        }
      }
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(points), gl.STATIC_DRAW);
      for (const [name, offset] of [['p', 0], ['n', 12]] as const) {
        const place = gl.getAttribLocation(program, name);
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 24, offset);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(corners), gl.STATIC_DRAW);
      gl.enable(gl.DEPTH_TEST);
      const turn = gl.getUniformLocation(program, 't');
      const at: number[] = [];
      await new Promise<void>((resolve) => {
        const frame = (now: number): void => {
          at.push(now);
          gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
          gl.uniform1f(turn, at.length / 50);
          for (const side of [0, 1]) {
            gl.viewport((side * gl.canvas.width) / 2, 0, gl.canvas.width / 2, gl.canvas.height);
            gl.drawElements(gl.TRIANGLES, corners.length, gl.UNSIGNED_INT, 0);
          }
          if (at.length < 90) {
            requestAnimationFrame(frame);
          } else {
            resolve();
          }
        };
        requestAnimationFrame(frame);
      });
      return at.slice(11).map((time, k) => time - (at[10 + k] ?? time));
    }, ROWS),
  );
}

test('turning two meshes of 100,000 triangles takes little longer than drawing them', { tag: ['@long', '@alone'] }, async ({ page, context }) => {
  await open(page);
  await page.locator('#source-file').setInputFiles(upload('three-waves.obj', wavy(3)));
  await expect(page.locator('#view-source')).toContainText('three-waves.obj', { timeout: 60_000 });
  await page.locator('#target-file').setInputFiles(upload('five-waves.obj', wavy(5)));
  await expect(page.locator('#view-target')).toContainText('five-waves.obj', { timeout: 60_000 });
  await page.waitForTimeout(4 * SETTLED);
  const shown = await turned(page);
  const size = await page.locator('#canvas').evaluate((canvas) => ({ width: (canvas as HTMLCanvasElement).width, height: (canvas as HTMLCanvasElement).height }));
  await page.close();
  const other = await context.newPage();
  const drawn = await bare(other, size);
  console.log(`${size.width} x ${size.height}: ${shown.toFixed(1)} ms a frame, bare ${drawn.toFixed(1)} ms`);
  expect(shown).toBeLessThan(1.2 * drawn);
});
