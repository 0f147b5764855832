// Pipelines of WebGPU, by WebGL2 (see webgl.js): programs of the shaders that the build translated, and the state they are drawn with.
import { SHADERS } from "./shaders.js";
import { comparison, known, refuse } from "./webgl-resources.js";

// Of GPUColorWrite: every colour.
const ALL = 0xf;
// A pass without colours draws depth alone.
const NO_FRAGMENTS = "#version 300 es\nvoid main() {}\n";

/// Makes pipelines on a context; programs that several have in common are made once.
export function pipelines(gl) {
  const programs = new Map();
  return (descriptor) => {
    const { vertex, fragment } = descriptor;
    const shaders = [shader(vertex, "vertex"), fragment ? shader(fragment, "fragment") : { glsl: NO_FRAGMENTS, uniforms: [], textures: [] }];
    const name = `${vertex.entryPoint} ${fragment?.entryPoint}`;
    if (!programs.has(name)) programs.set(name, program(gl, name, shaders));
    return { ...programs.get(name), ...state(gl, descriptor) };
  };
}

/// What the build made of an entry point. Of another text it would have made something else.
function shader({ module, entryPoint }, stage) {
  const shader = known(SHADERS, entryPoint, "shader");
  if (shader.stage !== stage || shader.sum !== sum(module.code)) refuse(`another shader of the name ${entryPoint}`);
  return shader;
}

/// As `sum` of the build (xtask/src/build/shaders.rs): FNV-1a of the units of a text.
function sum(text) {
  let sum = 0x811c9dc5;
  for (let k = 0; k < text.length; k++) sum = Math.imul(sum ^ text.charCodeAt(k), 0x01000193);
  return sum >>> 0;
}

// What stands for a program once the context is lost, which then makes none.
const LOST = { program: null, uniforms: [], textures: [] };

function program(gl, name, shaders) {
  const program = gl.createProgram();
  if (!program) return LOST;
  for (const [k, kind] of [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].entries()) {
    const part = gl.createShader(kind);
    if (!part) return LOST;
    gl.shaderSource(part, shaders[k].glsl);
    gl.compileShader(part);
    gl.attachShader(program, part);
    gl.deleteShader(part);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    if (gl.isContextLost()) return LOST;
    const said = gl.getAttachedShaders(program).map((part) => gl.getShaderInfoLog(part));
    throw new Error(`the shaders ${name} do not link: ${[gl.getProgramInfoLog(program), ...said].join("\n")}`);
  }
  gl.useProgram(program);
  // One place for each buffer, whichever stages read it.
  const uniforms = [];
  for (const { uniforms: blocks } of shaders) {
    for (const { group, binding, name } of blocks) {
      let place = uniforms.findIndex((other) => other.group === group && other.binding === binding);
      if (place < 0) place = uniforms.push({ group, binding }) - 1;
      const index = gl.getUniformBlockIndex(program, name);
      if (index !== gl.INVALID_INDEX) gl.uniformBlockBinding(program, index, place);
    }
  }
  const textures = shaders.flatMap((shader) => shader.textures);
  textures.forEach(({ name }, unit) => gl.uniform1i(gl.getUniformLocation(program, name), unit));
  return { program, uniforms, textures };
}

function state(gl, { vertex, fragment, primitive = {}, depthStencil, multisample }) {
  const topologies = { "triangle-list": gl.TRIANGLES, "triangle-strip": gl.TRIANGLE_STRIP };
  const faces = { front: gl.FRONT, back: gl.BACK };
  if (multisample?.alphaToCoverageEnabled) refuse("coverage by alpha");
  const target = fragment?.targets[0];
  if ((target?.writeMask ?? ALL) !== ALL) refuse("some of the colours");
  return {
    topology: known(topologies, primitive.topology ?? "triangle-list", "topology"),
    cull: primitive.cullMode === "none" ? null : known(faces, primitive.cullMode, "side"),
    // Turned over, for all is drawn upside down.
    front: primitive.frontFace === "cw" ? gl.CCW : gl.CW,
    depth: depthStencil && {
      write: depthStencil.depthWriteEnabled,
      compare: comparison(gl, depthStencil.depthCompare),
      slope: depthStencil.depthBiasSlopeScale ?? 0,
      bias: depthStencil.depthBias ?? 0,
    },
    blend: target?.blend && [factors(gl, target.blend.color), factors(gl, target.blend.alpha)],
    buffers: (vertex.buffers ?? []).map((buffer) => buffer && layout(gl, buffer)),
  };
}

function factors(gl, { srcFactor, dstFactor, operation = "add" }) {
  const all = { zero: gl.ZERO, one: gl.ONE, "src-alpha": gl.SRC_ALPHA, "one-minus-src-alpha": gl.ONE_MINUS_SRC_ALPHA };
  Object.assign(all, { "dst-alpha": gl.DST_ALPHA, "one-minus-dst-alpha": gl.ONE_MINUS_DST_ALPHA });
  if (operation !== "add") refuse(`blending by ${operation}`);
  return { from: known(all, srcFactor, "factor"), to: known(all, dstFactor, "factor") };
}

function layout(gl, { arrayStride, stepMode, attributes }) {
  const formats = {
    float32: [1, gl.FLOAT],
    float32x2: [2, gl.FLOAT],
    float32x3: [3, gl.FLOAT],
    float32x4: [4, gl.FLOAT],
    unorm8x4: [4, gl.UNSIGNED_BYTE],
    uint32: [1, gl.UNSIGNED_INT],
  };
  return {
    stride: arrayStride,
    divisor: stepMode === "instance" ? 1 : 0,
    attributes: Array.from(attributes, ({ format, offset, shaderLocation }) => {
      const [count, type] = known(formats, format, "vertex format");
      return { location: shaderLocation, count, type, whole: format === "uint32", offset };
    }),
  };
}
