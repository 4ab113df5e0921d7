// What the shaders know of each piece: a small table, so that another cut, colour or place costs a
// few kilobytes however many points there are.
import { DataTexture, FloatType, NearestFilter, RGBAFormat } from 'three';

const kWidth = 1024; // pieces a row
export const kTexelsOfPiece = 2;

/** How the shaders are to show a part. */
export interface PartLook {
  /** Colour, 0 … 1 a channel, sRGB. */
  color: readonly number[];
  /** Moves the part, in drawn units. */
  offset: readonly number[];
  /** 1 … 255, differs between neighbours; the lines between parts are drawn by it. */
  id: number;
  shown: boolean;
}

/** A texture of two texels a piece: offset and shown; colour and id. */
export class PartTable {
  readonly texture: DataTexture;
  private readonly data: Float32Array;

  /** `count` pieces; one more entry stands for points without a piece. */
  constructor(private readonly count: number) {
    const rows = Math.ceil(((count + 1) * kTexelsOfPiece) / kWidth);
    this.data = new Float32Array(4 * kWidth * rows);
    this.texture = new DataTexture(this.data, kWidth, rows, RGBAFormat, FloatType);
    this.texture.minFilter = NearestFilter;
    this.texture.magFilter = NearestFilter;
  }

  update(partOfPiece: Int32Array, looks: readonly PartLook[], without: PartLook): void {
    for (let piece = 0; piece <= this.count; ++piece) {
      const look = piece < this.count ? looks[partOfPiece[piece]] : without;
      const { offset, color } = look;
      this.data.set([offset[0], offset[1], offset[2], look.shown ? 1 : 0], 8 * piece);
      this.data.set([color[0], color[1], color[2], look.id / 255], 8 * piece + 4);
    }
    this.texture.needsUpdate = true;
  }
}

/** GLSL: reads texel `i` of a piece. */
export const kTableGlsl = /* glsl */ `
uniform sampler2D uTable;
vec4 ofPiece(uint piece, int i) {
  int at = int(piece) * ${kTexelsOfPiece} + i;
  return texelFetch(uTable, ivec2(at % ${kWidth}, at / ${kWidth}), 0);
}
`;

/** GLSL: light from over the viewer's left shoulder on a surface of any colour, all in sRGB. */
export const kLightGlsl = /* glsl */ `
vec3 lit(vec3 color, vec3 normal) {
  float key = max(0.0, dot(normal, normalize(vec3(-0.35, 0.55, 0.75))));
  float fill = 0.5 + 0.5 * normal.y;
  float light = 0.30 + 0.18 * fill + 0.62 * key;
  vec3 linear = pow(color, vec3(2.2)) * light + 0.04 * pow(key, 24.0);
  return pow(min(linear, vec3(1.0)), vec3(1.0 / 2.2));
}
`;
