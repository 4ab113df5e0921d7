// The picture of a shape: camera, what is drawn, and what lies under the pointer.
import {
  Color,
  Matrix4,
  PerspectiveCamera,
  Quaternion,
  Raycaster,
  Scene,
  Spherical,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { ballRadius, ellipsoidOf } from '../shape/ellipsoid';
import type { Vec3 } from '../shape/format';
import type { Model, View } from '../shape/model';
import { Finish } from './finish';
import { drawLabels } from './labels';
import { PartTable, type PartLook } from './part_table';
import { findAnchors, partAt, type Anchor, type Placement, type Projection } from './project';
import { rodGeometry, rodMatrix, Solids, sphereGeometry, type Solid } from './solids';
import { Splats } from './splats';

/** What stands for the parts; with balls or ellipsoids the points are dots to see through. */
export type Form = 'surface' | 'balls' | 'ellipsoids';

export interface Layers {
  form: Form;
  numbers: boolean;
  graph: boolean;
}

export interface Look {
  view: View;
  /** By part. */
  hidden: readonly boolean[];
  selected: number | null;
  hovered: number | null;
  /** How far the parts are pulled apart, 0 … 1. */
  spread: number;
  layers: Layers;
  dark: boolean;
}

const kFieldOfView = 30; // degrees
const kMostRatio = 2; // pixels of the canvas in a CSS pixel
const kSlow = 30; // milliseconds between frames; slower ones are drawn more coarsely
const kVerySlow = 60; // … and with fewer points
const kMostEvery = 32;
const kFewPoints = 10_000; // to draw fewer saves nothing
const kNode = 0.045; // radius of a node of the part graph, drawn units
const kMostNumbers = 40; // more of them over see-through parts hide the picture
const kBackground = { light: [0.965, 0.97, 0.978], dark: [0.1, 0.108, 0.128] } as const;

const mix = (a: readonly number[], b: readonly number[], share: number) =>
  a.map((x, i) => x + share * (b[i] - x));

export class Stage {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(kFieldOfView, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly table: PartTable;
  private readonly splats: Splats;
  private readonly balls: Solids;
  private readonly rods: Solids;
  private readonly finish = new Finish();
  private readonly background = new Color();
  private readonly extent: number; // radius of the shape about the origin, drawn units
  private placement: Placement | null = null;
  private look: Look | null = null;
  private centers: Vector3[] = [];
  private fitted = 1; // extent that the camera was fitted to
  private frame = 0;
  private ready = 0;
  private settle = 0;
  private warm = false;
  private coarse = false;
  private every = 1; // one of so many points is drawn while it moves
  /** Told when fewer points are drawn than there are: one of `every`. */
  onThin: (every: number) => void = () => undefined;
  private readonly software: boolean; // no graphics card: one sample a pixel

  /** Throws when the browser has no WebGL 2. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly overlay: HTMLCanvasElement,
    private readonly model: Model,
  ) {
    const { points, tree } = model.shape;
    this.renderer = new WebGLRenderer({ canvas, powerPreference: 'high-performance' });
    this.software = isSoftware(this.renderer);
    this.table = new PartTable(tree.count);
    this.splats = new Splats(points, this.table);
    this.balls = new Solids(sphereGeometry(), tree.count);
    this.rods = new Solids(rodGeometry(), tree.neckRadius.length);
    this.scene.add(this.splats.object, this.balls.object, this.rods.object);
    this.extent = extentOf(points.positions);
    const { view } = model.shape;
    this.camera.up.set(view[3], view[4], view[5]); // before the controls, which keep it
    this.controls = new OrbitControls(this.camera, canvas);
    this.resetCamera();
    this.controls.addEventListener('change', () => this.requestFrame());
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    cancelAnimationFrame(this.ready);
    clearTimeout(this.settle);
    this.controls.dispose();
    for (const part of [this.splats, this.balls, this.rods, this.finish]) part.dispose();
    this.table.texture.dispose();
    this.renderer.dispose();
  }

  // ---- what is shown ----------------------------------------------------------------------------

  update(look: Look): void {
    this.look = look;
    const background = kBackground[look.dark ? 'dark' : 'light'];
    this.background.setRGB(background[0], background[1], background[2]);
    const offsets = this.offsetsOf(look);
    const looks = look.view.parts.map((_, part) => this.lookOf(part, look, offsets[part]));
    const without: PartLook = {
      color: [0.63, 0.63, 0.63],
      offset: [0, 0, 0],
      id: 255,
      shown: true,
    };
    this.table.update(look.view.partOfPiece, looks, without);
    this.placement = {
      partOfPiece: look.view.partOfPiece,
      offsets: Float32Array.from(offsets.flat()),
      shown: Uint8Array.from(looks, ({ shown }) => (shown ? 1 : 0)),
    };
    this.setSolids(look, looks);
    this.fit(this.extent + Math.max(0, ...offsets.map((offset) => Math.hypot(...offset))));
    this.requestFrame();
  }

  private offsetsOf({ view, spread }: Look): number[][] {
    const centers = view.parts.map((part) => this.model.drawn(part.center));
    const middle = [0, 1, 2].map((axis) =>
      centers.reduce((sum, c, i) => sum + (c[axis] * view.parts[i].volume) / view.volume, 0),
    );
    this.centers = centers.map((c) =>
      new Vector3(...c).multiplyScalar(1 + spread).addScaledVector(new Vector3(...middle), -spread),
    );
    return centers.map((c) => c.map((x, axis) => spread * (x - middle[axis])));
  }

  private lookOf(part: number, look: Look, offset: number[]): PartLook {
    const background = kBackground[look.dark ? 'dark' : 'light'];
    let color: readonly number[] = look.view.colors[part];
    const marked = part === look.selected || part === look.hovered;
    if (look.selected !== null && !marked) color = mix(color, background, 0.72);
    if (part === look.hovered && part !== look.selected) color = mix(color, [1, 1, 1], 0.22);
    return { color, offset, id: 1 + (part % 250), shown: !look.hidden[part] };
  }

  private setSolids({ view, layers }: Look, looks: readonly PartLook[]): void {
    const { scale } = this.model.shape;
    const balls: Solid[] = [];
    const rods: Solid[] = [];
    view.parts.forEach((part, i) => {
      if (!looks[i].shown) return;
      const { color, id } = looks[i];
      const add = (matrix: Matrix4) => balls.push({ matrix, color, id });
      const center = this.centers[i];
      if (layers.form === 'balls') add(ballMatrix(center, ballRadius(part.volume) / scale));
      if (layers.form === 'ellipsoids') add(ellipsoidMatrix(center, part.covariance, scale));
      if (!layers.graph) return;
      if (layers.form === 'surface') add(ballMatrix(center, kNode));
      for (const { part: other, neckRadius } of part.neighbors) {
        if (other < i || !looks[other].shown) continue;
        const thickness = Math.min(0.025, Math.max(0.005, (0.12 * neckRadius) / scale));
        const matrix = rodMatrix(this.centers[i], this.centers[other], thickness);
        rods.push({ matrix, color: this.lineColor(), id: 254 });
      }
    });
    this.balls.set(balls);
    this.rods.set(rods);
  }

  private lineColor(): readonly number[] {
    return this.look?.dark ? [0.75, 0.77, 0.8] : [0.35, 0.37, 0.4];
  }

  // Whether the points are drawn as dots, so that what is inside shows.
  private get seeThrough(): boolean {
    const { form, graph } = this.look!.layers;
    return form !== 'surface' || graph;
  }

  // ---- camera -----------------------------------------------------------------------------------

  resetCamera(): void {
    const { view } = this.model.shape;
    this.camera.position
      .set(view[6], view[7], view[8])
      .multiplyScalar(this.distanceFor(this.fitted));
    this.controls.target.set(0, 0, 0);
    this.controls.update();
    this.requestFrame();
  }

  /** Turns the camera around the shape, in radians. */
  turn(right: number, up: number): void {
    const toUp = new Quaternion().setFromUnitVectors(this.camera.up, new Vector3(0, 1, 0));
    const offset = this.camera.position.clone().sub(this.controls.target).applyQuaternion(toUp);
    const at = new Spherical().setFromVector3(offset);
    at.theta -= right;
    at.phi -= up;
    at.makeSafe();
    offset.setFromSpherical(at).applyQuaternion(toUp.invert());
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.requestFrame();
  }

  /** Above 1: nearer. */
  zoom(factor: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target).divideScalar(factor);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.requestFrame();
  }

  private distanceFor(extent: number): number {
    const half = (kFieldOfView / 2) * (Math.PI / 180);
    const narrow = Math.atan(Math.tan(half) * Math.min(1, this.camera.aspect));
    return (1.03 * extent) / Math.sin(narrow);
  }

  // Keeps what is shown as large as it was when the parts move.
  private fit(extent: number): void {
    if (Math.abs(extent - this.fitted) > 1e-9) this.zoom(this.fitted / extent);
    this.fitted = extent;
  }

  /** Takes over the size of the canvas on the page. */
  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    const ratio = this.software ? 1 : Math.min(devicePixelRatio, kMostRatio);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.overlay.width = this.canvas.width;
    this.overlay.height = this.canvas.height;
    const before = this.distanceFor(this.fitted);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.zoom(before / this.distanceFor(this.fitted));
  }

  // ---- drawing ----------------------------------------------------------------------------------

  private requestFrame(): void {
    clearTimeout(this.settle);
    if (this.frame !== 0) return;
    this.frame = requestAnimationFrame((begin) => {
      this.frame = 0;
      const { coarse } = this;
      this.onThin(this.every);
      this.render(coarse, this.every);
      // The browser calls again when it is ready for the next frame, asked for or not.
      this.ready = requestAnimationFrame((end) => {
        if (this.warm) this.judge(end - begin);
        this.warm = true; // the first one had the shaders to compile
        if (coarse && this.frame === 0) this.settle = window.setTimeout(() => this.rest(), 300);
      });
    });
  }

  // A slow frame makes those after it coarser until the movement ends.
  private judge(took: number): void {
    const { count } = this.model.shape.points;
    if (took > kSlow) this.coarse = true;
    const fewer = count / this.every > kFewPoints && this.every < kMostEvery;
    if (took > kVerySlow && fewer) this.every *= 2;
  }

  // Nothing moves: everything is drawn, however long it takes. The next movement begins finer.
  private rest(): void {
    this.render(false);
    this.onThin(1);
    if (this.every > 1) this.every /= 2;
    else this.coarse = false;
  }

  /** Draws now. `coarse`: one sample a pixel; one of `every` points. */
  render(coarse = false, every = 1): void {
    const { look } = this;
    if (!look || this.canvas.width === 0) return;
    this.canvas.toggleAttribute('data-coarse', coarse); // more is to come
    const ratio = this.renderer.getPixelRatio();
    const factor = coarse || this.software || ratio >= 1.5 ? 1 : 2;
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = Math.max(0.01, distance - 2 * this.fitted);
    this.camera.far = distance + 2 * this.fitted;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    const dot = this.seeThrough ? 1.8 * ratio * factor : 0;
    this.splats.update(this.pixels() * ratio * factor, dot, this.background, every);
    this.finish.render(this.renderer, this.scene, this.camera, {
      factor,
      background: this.background,
      dark: look.dark,
    });
    this.drawOverlay(look);
  }

  private drawOverlay(look: Look): void {
    const context = this.overlay.getContext('2d')!;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.overlay.width, this.overlay.height);
    if (!look.layers.numbers) return;
    const { dark, selected } = look;
    drawLabels(context, this.anchors(), { ratio: this.renderer.getPixelRatio(), dark, selected });
  }

  private anchors(): Anchor[] {
    const projection = this.projection();
    if (!this.seeThrough) {
      return findAnchors(this.model.shape.points, this.placement!, projection);
    }
    const shown = this.centers.map((center, part) => {
      const at = center.clone().project(this.camera);
      return {
        part,
        x: (0.5 + 0.5 * at.x) * projection.width,
        y: (0.5 - 0.5 * at.y) * projection.height,
        depth: at.z,
      };
    });
    return shown.filter(
      ({ part, x, y }) =>
        this.placement!.shown[part] && part < kMostNumbers && this.solidAt(x, y) === part,
    );
  }

  // CSS pixels of one unit at distance 1.
  private pixels(): number {
    return this.canvas.clientHeight / 2 / Math.tan((kFieldOfView / 2) * (Math.PI / 180));
  }

  private projection(): Projection {
    const { projectionMatrix, matrixWorldInverse } = this.camera;
    return {
      matrix: new Matrix4().multiplyMatrices(projectionMatrix, matrixWorldInverse).elements,
      width: this.canvas.clientWidth,
      height: this.canvas.clientHeight,
      pixels: this.pixels(),
    };
  }

  /** The part at a place of the canvas in CSS pixels, or null. */
  partAt(x: number, y: number): number | null {
    if (!this.look || !this.placement) return null;
    if (this.seeThrough) {
      const part = this.solidAt(x, y);
      if (part !== null) return part;
    }
    return partAt(this.model.shape.points, this.placement, this.projection(), x, y);
  }

  private solidAt(x: number, y: number): number | null {
    const { clientWidth, clientHeight } = this.canvas;
    const ray = new Raycaster();
    const at = new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight);
    ray.setFromCamera(at, this.camera);
    this.balls.object.boundingSphere = null;
    const hit = ray.intersectObject(this.balls.object)[0];
    if (hit?.instanceId === undefined) return null;
    const shown = Array.from(this.placement!.shown.keys()).filter((i) => this.placement!.shown[i]);
    return shown[hit.instanceId];
  }

  /** The picture as it is on the page, as PNG. */
  async picture(): Promise<Blob> {
    this.render(false);
    const sheet = document.createElement('canvas');
    sheet.width = this.canvas.width;
    sheet.height = this.canvas.height;
    const context = sheet.getContext('2d')!;
    context.drawImage(this.canvas, 0, 0);
    context.drawImage(this.overlay, 0, 0);
    return new Promise((done, fail) =>
      sheet.toBlob((blob) => (blob ? done(blob) : fail(new Error('no picture'))), 'image/png'),
    );
  }
}

function isSoftware(renderer: WebGLRenderer): boolean {
  const gl = renderer.getContext();
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  const name = names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
  return /swiftshader|llvmpipe|software/i.test(name);
}

export function extentOf(positions: Uint16Array): number {
  let largest = 0;
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = [0, 1, 2].map((axis) => positions[i + axis] / 32767.5 - 1);
    largest = Math.max(largest, x * x + y * y + z * z);
  }
  return Math.sqrt(largest) || 1;
}

const ballMatrix = (center: Vector3, radius: number) =>
  new Matrix4().makeScale(radius, radius, radius).setPosition(center);

function ellipsoidMatrix(center: Vector3, covariance: readonly number[], scale: number): Matrix4 {
  const { axes, radii } = ellipsoidOf(covariance);
  const columns = axes.map((axis, i) =>
    new Vector3(...(axis as unknown as Vec3)).multiplyScalar(Math.max(1e-3, radii[i] / scale)),
  );
  return new Matrix4().makeBasis(columns[0], columns[1], columns[2]).setPosition(center);
}
