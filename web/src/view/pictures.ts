// Small pictures of several shapes that turn together. One WebGL context draws them all, as browsers
// allow few: each is copied to a canvas of its own.
import {
  Color,
  Matrix4,
  PerspectiveCamera,
  Quaternion,
  Scene,
  Vector3,
  WebGLRenderer,
} from 'three';
import type { Picture } from '../shape/format';
import { Finish } from './finish';
import { PartTable, type PartLook } from './part_table';
import { Splats } from './splats';
import { extentOf } from './stage';

const kFieldOfView = 30; // degrees
const kMostRatio = 2;
const kGrey = [0.63, 0.63, 0.63];

interface Entry {
  canvas: HTMLCanvasElement;
  splats: Splats;
  table: PartTable;
  extent: number;
}

export class Pictures {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(kFieldOfView, 1, 0.01, 100);
  private readonly finish = new Finish();
  private readonly background = new Color();
  private readonly entries: Entry[] = [];
  private readonly end = new AbortController();
  private readonly turned = new Quaternion();
  private readonly pose = new Quaternion();
  private frame = 0;

  /** Throws when the browser has no WebGL 2. `pose` is the first view of the shape all lie on. */
  constructor(
    pose: readonly number[],
    private readonly dark: () => boolean,
  ) {
    this.renderer = new WebGLRenderer({ powerPreference: 'high-performance' });
    const m = new Matrix4().set(
      pose[0],
      pose[1],
      pose[2],
      0,
      pose[3],
      pose[4],
      pose[5],
      0,
      pose[6],
      pose[7],
      pose[8],
      0,
      0,
      0,
      0,
      1,
    );
    this.pose.setFromRotationMatrix(m);
    const { signal } = this.end;
    addEventListener('scroll', () => this.requestFrame(), { signal, passive: true });
    addEventListener('resize', () => this.requestFrame(), { signal });
  }

  /** Shows a picture in `canvas`; dragging it turns all. `parts`: how many have a colour. */
  add(canvas: HTMLCanvasElement, picture: Picture, parts: number): void {
    const table = new PartTable(parts);
    const look = (color: readonly number[], id: number): PartLook => ({
      color,
      offset: [0, 0, 0],
      id,
      shown: true,
    });
    const looks = Array.from({ length: parts }, (_, part) =>
      look(
        picture.palette[part % picture.palette.length].map((c) => c / 255),
        1 + (part % 250),
      ),
    );
    table.update(Int32Array.from(looks.keys()), looks, look(kGrey, 255));
    const splats = new Splats(picture.points, table);
    this.entries.push({ canvas, splats, table, extent: extentOf(picture.points.positions) });
    this.listen(canvas);
    this.requestFrame();
  }

  /** Turns all, in radians. */
  turn(right: number, up: number): void {
    const about = (x: number, y: number, angle: number) =>
      new Quaternion().setFromAxisAngle(new Vector3(x, y, 0), angle);
    this.turned
      .premultiply(about(0, 1, right))
      .premultiply(about(1, 0, up))
      .normalize();
    this.requestFrame();
  }

  resetPose(): void {
    this.turned.identity();
    this.requestFrame();
  }

  dispose(): void {
    this.end.abort();
    cancelAnimationFrame(this.frame);
    for (const { splats, table } of this.entries) {
      splats.dispose();
      table.texture.dispose();
    }
    this.finish.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private listen(canvas: HTMLCanvasElement): void {
    const { signal } = this.end;
    let last: PointerEvent | null = null;
    canvas.addEventListener(
      'pointerdown',
      (event) => {
        last = event;
        canvas.setPointerCapture(event.pointerId);
      },
      { signal },
    );
    canvas.addEventListener(
      'pointermove',
      (event) => {
        if (!last) return;
        const radians = 3.5 / canvas.clientWidth;
        this.turn(
          radians * (event.clientX - last.clientX),
          radians * (event.clientY - last.clientY),
        );
        last = event;
      },
      { signal },
    );
    for (const name of ['pointerup', 'pointercancel'] as const) {
      canvas.addEventListener(name, () => (last = null), { signal });
    }
  }

  requestFrame(): void {
    if (this.frame !== 0 || this.end.signal.aborted) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      for (const entry of this.entries) if (isInView(entry.canvas)) this.draw(entry);
    });
  }

  private draw({ canvas, splats, extent }: Entry): void {
    const ratio = Math.min(devicePixelRatio, kMostRatio);
    const width = Math.round(canvas.clientWidth * ratio);
    const height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const sheet = this.renderer.domElement;
    if (sheet.width !== width || sheet.height !== height) {
      this.renderer.setSize(width, height, false);
    }
    const half = (kFieldOfView / 2) * (Math.PI / 180);
    const distance =
      (1.03 * extent) / Math.sin(Math.atan(Math.tan(half) * Math.min(1, width / height)));
    this.camera.position.set(0, 0, distance);
    this.camera.aspect = width / height;
    this.camera.near = Math.max(0.01, distance - 2 * extent);
    this.camera.far = distance + 2 * extent;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    const dark = this.dark();
    const [r, g, b] = dark ? [0.133, 0.145, 0.173] : [1, 1, 1];
    this.background.setRGB(r, g, b);
    splats.object.quaternion.copy(this.turned).multiply(this.pose);
    this.scene.clear();
    this.scene.add(splats.object);
    splats.update(height / 2 / Math.tan(half), 0, this.background);
    this.finish.render(this.renderer, this.scene, this.camera, {
      factor: 1,
      background: this.background,
      dark,
    });
    canvas.getContext('2d')!.drawImage(sheet, 0, 0);
  }
}

function isInView(element: Element): boolean {
  const { top, bottom, width } = element.getBoundingClientRect();
  return width > 0 && bottom > -100 && top < innerHeight + 100;
}
