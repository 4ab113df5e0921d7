// The shape that a page carries, as src/html/shape_json.cpp writes it.

export type Vec3 = readonly [number, number, number];

/** The points that are drawn; (n) each, or as said. */
export interface Points {
  count: number;
  /** (n, 3) of the box [-1, 1]^3, 0 … 65535. */
  positions: Uint16Array;
  /** (n, 4) quaternions x, y, z, w in units of 1/127 that take x, y, z to the axes and the normal. */
  turns: Int8Array;
  /** (n, 2) half axes of the surface element in units of longestRadius/255; the second is 0: a ball. */
  radii: Uint8Array;
  longestRadius: number;
  /** Piece of each point; tree.count where it has none. */
  pieces: Uint32Array;
}

/** morsel::MergeTree: what `cut` needs, exactly as in C++. */
export interface MergeTree {
  /** Number of pieces p. */
  count: number;
  origin: Vec3;
  /** (p, 10) about origin: volume, first and second moments (xx, xy, xz, yy, yz, zz). */
  moments: Float64Array;
  pointCount: Uint32Array;
  ballCenter: Float64Array;
  ballRadius: Float64Array;
  /** (m) ascending in ratio. */
  mergeRatio: Float64Array;
  mergeA: Uint32Array;
  mergeB: Uint32Array;
  mergeSignificant: Uint8Array;
  neckA: Uint32Array;
  neckB: Uint32Array;
  neckRadius: Float64Array;
  /** Objects that do not touch. */
  objects: number;
}

/** Points in the colours of their parts, as src/html/shape_json.cpp writes them. */
export interface Picture {
  /** A point p of the input is drawn at (p - center) / scale. */
  center: Vec3;
  scale: number;
  /** Rows of the rotation to the first view: right, up, towards the viewer. */
  view: readonly number[];
  palette: readonly Vec3[];
  points: Points;
}

export interface Shape extends Picture {
  /** Version of the program that wrote it. */
  version: string;
  name: string;
  pointsOfInput: number;
  /** Where the tree was cut. */
  mergeRatio: number;
  tree: MergeTree;
}

const kTypes = {
  u8: Uint8Array,
  i8: Int8Array,
  u16: Uint16Array,
  u32: Uint32Array,
  f64: Float64Array,
} as const;

type TypedArray = InstanceType<(typeof kTypes)[keyof typeof kTypes]>;

function decode(field: { type: keyof typeof kTypes; data: string }): TypedArray {
  const text = atob(field.data);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new kTypes[field.type](bytes.buffer);
}

/** What JSON.parse gives. */
type Json = ReturnType<typeof JSON.parse>;

/** Reads what both kinds of pages show. */
export function pictureOf(json: Json): Picture {
  const { points } = json;
  const pieces = Uint32Array.from(decode(points.pieces));
  return {
    center: json.center,
    scale: json.scale,
    view: json.view,
    palette: json.palette,
    points: {
      count: pieces.length,
      positions: decode(points.positions) as Uint16Array,
      turns: decode(points.turns) as Int8Array,
      radii: decode(points.radii) as Uint8Array,
      longestRadius: points.longest_radius,
      pieces,
    },
  };
}

/** Reads the JSON text of a page's shape. */
export function parseShape(text: string): Shape {
  const json = JSON.parse(text);
  const { tree } = json;
  const ballRadius = decode(tree.ball_radius) as Float64Array;
  return {
    ...pictureOf(json),
    version: json.morsel,
    name: json.name,
    pointsOfInput: json.points_of_input,
    mergeRatio: json.merge_ratio,
    tree: {
      count: ballRadius.length,
      origin: tree.origin,
      moments: decode(tree.moments) as Float64Array,
      pointCount: decode(tree.point_count) as Uint32Array,
      ballCenter: decode(tree.ball_center) as Float64Array,
      ballRadius,
      mergeRatio: decode(tree.merge_ratio) as Float64Array,
      mergeA: decode(tree.merge_a) as Uint32Array,
      mergeB: decode(tree.merge_b) as Uint32Array,
      mergeSignificant: decode(tree.merge_significant) as Uint8Array,
      neckA: decode(tree.neck_a) as Uint32Array,
      neckB: decode(tree.neck_b) as Uint32Array,
      neckRadius: decode(tree.neck_radius) as Float64Array,
      objects: tree.objects,
    },
  };
}
