// WebGPU where the browser has WebGL2 alone: as much of it as the page uses, under the standard's names and with its meanings, so that one
// program draws with either. It lies in the place of `navigator.gpu` and of the canvas's context.
import { Encoder, present } from "./webgl-commands.js";
import { pipelines } from "./webgl-pipelines.js";
import { Buffer, Sampler, Texture } from "./webgl-resources.js";

// As much as a browser gives by itself with WebGPU.
const LARGEST_BUFFER = 2 ** 28;
// Of GPUTextureUsage.
const RENDER_ATTACHMENT = 0x10;

/// Puts it in the place of WebGPU until `navigator.gpu` is deleted, drawing on `canvas`, which must be fresh. Throws where there is no WebGL2.
export function provide(canvas) {
  const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false, stencil: false });
  if (!gl || gl.isContextLost()) throw new Error("the browser gives no WebGL2 context");
  const surface = new Surface(gl);
  canvas.getContext = (kind) => (kind === "webgpu" ? surface : HTMLCanvasElement.prototype.getContext.call(canvas, kind));
  Object.defineProperty(navigator, "gpu", { configurable: true, value: new Gpu(gl, surface) });
}

class Gpu {
  #gl;
  #surface;

  constructor(gl, surface) {
    this.#gl = gl;
    this.#surface = surface;
  }

  getPreferredCanvasFormat() {
    return "rgba8unorm";
  }

  async requestAdapter() {
    return new Adapter(this.#gl, this.#surface);
  }
}

class Adapter {
  features = new Set();
  info = { vendor: "", architecture: "", device: "", description: "WebGL2" };
  #gl;
  #surface;

  constructor(gl, surface) {
    this.#gl = gl;
    this.#surface = surface;
    const side = Math.min(gl.getParameter(gl.MAX_TEXTURE_SIZE), gl.getParameter(gl.MAX_RENDERBUFFER_SIZE));
    this.limits = {
      maxTextureDimension1D: side,
      maxTextureDimension2D: side,
      maxTextureDimension3D: gl.getParameter(gl.MAX_3D_TEXTURE_SIZE),
      maxBufferSize: LARGEST_BUFFER,
    };
  }

  async requestDevice() {
    return new Device(this.#gl, this.#surface, this);
  }
}

class Device {
  features = new Set();
  // Never called: what is wrong, WebGL says to the console.
  onuncapturederror = null;
  #gl;
  #pipeline;
  #end;

  constructor(gl, surface, { limits, info }) {
    this.#gl = gl;
    this.limits = limits;
    this.adapterInfo = info;
    this.queue = new Queue(surface);
    this.#pipeline = pipelines(gl);
    this.lost = new Promise((end) => (this.#end = end));
    const lose = () => this.#end({ reason: "unknown", message: "The WebGL context was lost." });
    gl.canvas.addEventListener("webglcontextlost", lose);
    if (gl.isContextLost()) lose();
  }

  createBuffer(descriptor) {
    return new Buffer(this.#gl, descriptor);
  }

  createTexture(descriptor) {
    return new Texture(this.#gl, descriptor);
  }

  createSampler(descriptor) {
    return new Sampler(this.#gl, descriptor);
  }

  createShaderModule({ code }) {
    return { code };
  }

  // What is bound where, the shaders say.
  createBindGroupLayout() {
    return {};
  }

  createPipelineLayout() {
    return {};
  }

  createBindGroup({ entries }) {
    return new Map(entries.map(({ binding, resource }) => [binding, resource]));
  }

  createRenderPipeline(descriptor) {
    return this.#pipeline(descriptor);
  }

  createCommandEncoder(descriptor) {
    return new Encoder(this.#gl, descriptor);
  }
}

class Queue {
  #surface;

  constructor(surface) {
    this.#surface = surface;
  }

  writeBuffer(buffer, offset, data, from = 0, size = data.length - from) {
    buffer.write(offset, data, from, size);
  }

  writeTexture({ texture, origin }, data, layout, size) {
    texture.write(origin, data, layout, size);
  }

  submit(buffers) {
    for (const commands of buffers) for (const command of commands) command();
    this.#surface.show();
  }
}

/// The canvas. WebGPU counts rows from the top, WebGL from the bottom: all is drawn upside down, and turned over as it comes on the canvas.
class Surface {
  #gl;
  #texture = null;
  #waits = false;

  constructor(gl) {
    this.#gl = gl;
  }

  configure({ format }) {
    if (format !== "rgba8unorm") throw new TypeError(`WebGL cannot give the canvas the format ${format}`);
  }

  unconfigure() {
    this.#texture?.destroy();
    this.#texture = null;
  }

  getCurrentTexture() {
    const { width, height } = this.#gl.canvas;
    if (this.#texture?.width !== width || this.#texture.height !== height) {
      this.unconfigure();
      this.#texture = new Texture(this.#gl, { format: "rgba8unorm", size: { width, height }, usage: RENDER_ATTACHMENT });
    }
    this.#waits = true;
    return this.#texture;
  }

  /// What was drawn comes on the canvas.
  show() {
    if (!this.#waits) return;
    this.#waits = false;
    present(this.#gl, this.#texture);
  }
}
