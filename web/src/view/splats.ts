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
uniform int uEvery;     // one of so many points is a dot
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
  bool left_out = uDot > 0.0 && gl_VertexID % uEvery != 0;
  if (place.w == 0.0 || left_out) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  vec4 q = normalize(turn);
  mat3 view = mat3(modelViewMatrix);
  float longest = max(radii.x, radii.y);
  float radius = uRadius * longest;
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

export class Splats {
  readonly object: ThreePoints;
  private readonly material: RawShaderMaterial;

  constructor(points: Points, table: PartTable) {
    const geometry = new BufferGeometry();
    const piece = new BufferAttribute(points.pieces, 1);
    piece.gpuType = IntType;
    geometry.setAttribute('position', new BufferAttribute(points.positions, 3, true));
    geometry.setAttribute('turn', new BufferAttribute(points.turns, 4, true));
    geometry.setAttribute('radii', new BufferAttribute(points.radii, 2, true));
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
        uEvery: { value: Math.ceil(points.count / kDots) },
        uBackground: { value: new Color() },
      },
    });
    this.object = new ThreePoints(geometry, this.material);
    this.object.frustumCulled = false;
  }

  /** `pixels` of one unit at distance 1; `dot` pixels of a dot, or 0 for a closed surface. */
  update(pixels: number, dot: number, background: Color): void {
    const { uniforms } = this.material;
    uniforms.uPixels.value = pixels;
    uniforms.uDot.value = dot;
    uniforms.uBackground.value.copy(background);
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.material.dispose();
  }
}
