// The last pass: dark lines around silhouettes and between parts, smooth edges, background.
// Source of the lines: C. Boucheny, "Visualisation scientifique de grands volumes de données",
// thesis, 2009 (eye-dome lighting).
import {
  Color,
  DepthTexture,
  FloatType,
  GLSL3,
  Mesh,
  NearestFilter,
  OrthographicCamera,
  PlaneGeometry,
  RawShaderMaterial,
  Scene,
  WebGLRenderTarget,
  type PerspectiveCamera,
  type WebGLRenderer,
} from 'three';

const kVertex = /* glsl */ `
in vec3 position;
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }
`;

const kFragment = /* glsl */ `
precision highp float;
uniform sampler2D uColor;  // a: id of the part, 0 where no lines are drawn
uniform sampler2D uDepth;
uniform vec2 uRange;       // near, far
uniform float uSize;       // units that count as a step in depth
uniform int uFactor;       // samples a pixel and direction
uniform int uReach;        // samples to look around for lines
uniform vec3 uBackground;
uniform vec3 uRim;         // colour of silhouettes against the background
out vec4 color;
float distanceAt(ivec2 at) {
  float depth = texelFetch(uDepth, at, 0).r;
  return depth == 1.0 ? 1e6 : uRange.x * uRange.y / (uRange.y - depth * (uRange.y - uRange.x));
}
vec4 sampleAt(ivec2 at, ivec2 size) {
  float depth = texelFetch(uDepth, at, 0).r;
  vec4 here = texelFetch(uColor, at, 0);
  if (depth == 1.0) here.rgb = uBackground;
  if (here.a == 0.0) return here;
  float mine = distanceAt(at);
  float edge = 0.0;
  float border = 0.0;
  float rim = 0.0;
  for (int i = 0; i < 8; ++i) {
    float angle = 0.785398 * float(i);
    vec2 step = float(uReach) * vec2(cos(angle), sin(angle));
    ivec2 beside = clamp(at + ivec2(round(step)), ivec2(0), size - 1);
    vec4 there = texelFetch(uColor, beside, 0);
    float deeper = distanceAt(beside) - mine;
    if (deeper > 1e5) rim += 1.0;
    else edge += clamp(deeper / uSize - 0.35, 0.0, 1.0);
    if (there.a > 0.0 && there.a != here.a && abs(deeper) < uSize) border += 1.0;
  }
  float dark = min(1.0, 0.14 * edge) + min(0.5, 0.13 * border);
  here.rgb *= 1.0 - 0.75 * min(1.0, dark);
  here.rgb = mix(here.rgb, uRim, min(0.7, 0.14 * rim));
  return here;
}
void main() {
  ivec2 size = textureSize(uColor, 0);
  ivec2 first = uFactor * ivec2(gl_FragCoord.xy);
  vec3 sum = vec3(0.0);
  for (int y = 0; y < uFactor; ++y) {
    for (int x = 0; x < uFactor; ++x) sum += sampleAt(first + ivec2(x, y), size).rgb;
  }
  color = vec4(sum / float(uFactor * uFactor), 1.0);
}
`;

export interface FinishStyle {
  /** Samples a pixel and direction. */
  factor: number;
  background: Color;
  dark: boolean;
}

export class Finish {
  private readonly target: WebGLRenderTarget;
  private readonly material: RawShaderMaterial;
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera();
  private readonly quad: Mesh;

  constructor() {
    this.target = new WebGLRenderTarget(1, 1, {
      minFilter: NearestFilter,
      magFilter: NearestFilter,
      depthTexture: new DepthTexture(1, 1, FloatType),
    });
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      depthTest: false,
      depthWrite: false,
      uniforms: {
        uColor: { value: this.target.texture },
        uDepth: { value: this.target.depthTexture },
        uRange: { value: [0, 1] },
        uSize: { value: 0.03 },
        uFactor: { value: 1 },
        uReach: { value: 1 },
        uBackground: { value: new Color() },
        uRim: { value: new Color() },
      },
    });
    this.quad = new Mesh(new PlaneGeometry(2, 2), this.material);
    this.quad.frustumCulled = false;
    this.scene.add(this.quad);
  }

  /** Draws the scene on the canvas. */
  render(
    renderer: WebGLRenderer,
    scene: Scene,
    camera: PerspectiveCamera,
    style: FinishStyle,
  ): void {
    const { factor, background, dark } = style;
    const { width, height } = renderer.domElement;
    this.target.setSize(width * factor, height * factor);
    const { uniforms } = this.material;
    uniforms.uRange.value = [camera.near, camera.far];
    uniforms.uFactor.value = factor;
    uniforms.uReach.value = Math.max(1, Math.round((factor * height) / 700));
    uniforms.uBackground.value.copy(background);
    uniforms.uRim.value.setScalar(dark ? 0.75 : 0.1);
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0x000000, 0);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.scene, this.camera);
  }

  dispose(): void {
    this.target.depthTexture?.dispose();
    this.target.dispose();
    this.quad.geometry.dispose();
    this.material.dispose();
  }
}
