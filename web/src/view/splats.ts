// The points, drawn as small oriented ellipses that close the surface, or as dots to see through.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  GLSL3,
  IntType,
  Points as ThreePoints,
  RawShaderMaterial,
} from 'three';
import type { Points } from '../shape/format';
import { kLightGlsl, kTableGlsl, type PartTable } from './part_table';

const kVertex = /* glsl */ `
precision highp float;
precision highp int;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform float uPixels;  // of one unit at distance 1
uniform float uRadius;  // of the longest half axis
uniform float uDot;     // pixels of a dot, 0: ellipses
uniform float uSpread;  // radii grow by this where points are left out
in vec3 position;
in vec4 turn;
in vec2 radii;
in uint piece;
flat out vec3 vColor;
flat out float vId;
flat out vec3 vMajor;   // view space; half axes in units of the larger one
flat out vec3 vMinor;
flat out vec3 vNormal;
flat out vec2 vDepth;   // z of the centre, radius
${kTableGlsl}
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
void main() {
  vec4 place = ofPiece(piece, 0);
  vec4 look = ofPiece(piece, 1);
  vColor = look.rgb;
  vId = look.a;
  vec4 at = modelViewMatrix * vec4(position * 2.0 - 1.0 + place.xyz, 1.0);
  gl_Position = projectionMatrix * at;
  if (place.w == 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  vec4 q = normalize(turn);
  mat3 view = mat3(modelViewMatrix);
  float longest = max(radii.x, radii.y);
  float radius = uRadius * longest * uSpread;
  vMajor = view * turned(q, vec3(1.0, 0.0, 0.0)) * radii.x / longest;
  vMinor = view * turned(q, vec3(0.0, 1.0, 0.0)) * radii.y / longest;
  vNormal = radii.y == 0.0 ? vec3(0.0) : view * turned(q, vec3(0.0, 0.0, 1.0));
  if (vNormal.z < 0.0) vNormal = -vNormal;
  vDepth = vec2(at.z, radius);
  gl_PointSize = uDot > 0.0 ? uDot : max(2.0 * radius * uPixels / -at.z, 2.0);
}
`;

const kFragment = /* glsl */ `
precision highp float;
uniform mat4 projectionMatrix;
uniform float uDot;
uniform vec3 uBackground;
flat in vec3 vColor;
flat in float vId;
flat in vec3 vMajor;
flat in vec3 vMinor;
flat in vec3 vNormal;
flat in vec2 vDepth;
out vec4 color;
${kLightGlsl}
void main() {
  vec2 at = vec2(2.0, -2.0) * (gl_PointCoord - 0.5);
  gl_FragDepth = gl_FragCoord.z;
  if (uDot > 0.0) {
    if (dot(at, at) > 1.0) discard;
    color = vec4(mix(uBackground, vColor, 0.65), 0.0);
    return;
  }
  vec3 offset = vec3(at, 0.0);
  vec3 normal = vNormal;
  if (normal == vec3(0.0)) {  // a ball
    float square = dot(at, at);
    if (square > 1.0) discard;
    normal = vec3(at, sqrt(1.0 - square));
    offset = normal;
  } else {
    offset.z = clamp(-dot(normal.xy, at) / max(normal.z, 0.05), -1.0, 1.0);
    float along = dot(offset, vMajor) / dot(vMajor, vMajor);
    float across = dot(offset, vMinor) / dot(vMinor, vMinor);
    if (along * along + across * across > 1.0) discard;
  }
  float z = vDepth.x + offset.z * vDepth.y;
  gl_FragDepth = 0.5 - 0.5 * (projectionMatrix[2].z * z + projectionMatrix[3].z) / z;
  color = vec4(lit(vColor, normal), vId);
}
`;

const kDots = 10_000; // more of them hide what they surround
const kBits = 9;

/**
 * Indices 0 … count - 1 so that every beginning of the list is spread over all of it: by their last
 * bits, mirrored.
 */
export function spreadOrder(count: number): Uint32Array {
  const order = new Uint32Array(count);
  const step = 2 ** kBits;
  let next = 0;
  for (let i = 0; i < step; ++i) {
    let first = 0;
    for (let bit = 0; bit < kBits; ++bit) first |= ((i >> bit) & 1) << (kBits - 1 - bit);
    for (let at = first; at < count; at += step) order[next++] = at;
  }
  return order;
}

// The rows of an array, `width` values each, in another order.
function inOrder<Values extends Uint8Array | Int8Array | Uint16Array | Uint32Array>(
  values: Values,
  width: number,
  order: Uint32Array,
): Values {
  const result = values.slice() as Values;
  order.forEach((from, to) => {
    for (let k = 0; k < width; ++k) result[width * to + k] = values[width * from + k];
  });
  return result;
}

export class Splats {
  readonly object: ThreePoints;
  private readonly material: RawShaderMaterial;
  private readonly count: number;

  constructor(points: Points, table: PartTable) {
    this.count = points.count;
    const order = spreadOrder(points.count);
    const geometry = new BufferGeometry();
    const piece = new BufferAttribute(inOrder(points.pieces, 1, order), 1);
    piece.gpuType = IntType;
    geometry.setAttribute(
      'position',
      new BufferAttribute(inOrder(points.positions, 3, order), 3, true),
    );
    geometry.setAttribute('turn', new BufferAttribute(inOrder(points.turns, 4, order), 4, true));
    geometry.setAttribute('radii', new BufferAttribute(inOrder(points.radii, 2, order), 2, true));
    geometry.setAttribute('piece', piece);
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      uniforms: {
        uTable: { value: table.texture },
        uPixels: { value: 1 },
        uRadius: { value: points.longestRadius },
        uDot: { value: 0 },
        uSpread: { value: 1 },
        uBackground: { value: new Color() },
      },
    });
    this.object = new ThreePoints(geometry, this.material);
    this.object.frustumCulled = false;
  }

  /**
   * `pixels` of one unit at distance 1; `dot` pixels of a dot, or 0 for a closed surface; one of
   * `every` points is drawn.
   */
  update(pixels: number, dot: number, background: Color, every = 1): void {
    const { uniforms } = this.material;
    const drawn = Math.ceil(this.count / every);
    this.object.geometry.setDrawRange(0, dot > 0 ? Math.min(kDots, drawn) : drawn);
    uniforms.uSpread.value = Math.sqrt(every);
    uniforms.uPixels.value = pixels;
    uniforms.uDot.value = dot;
    uniforms.uBackground.value.copy(background);
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.material.dispose();
  }
}
