// Commands of WebGPU, by WebGL2 (see webgl.js): kept as they are encoded, drawn when they are submitted.
import { refuse } from "./webgl-resources.js";

export class Encoder {
  #gl;
  #commands = [];

  constructor(gl, { label = "" } = {}) {
    this.#gl = gl;
    this.label = label;
  }

  beginRenderPass(descriptor) {
    const commands = this.#commands;
    const drawn = new DrawnPass(this.#gl, descriptor);
    commands.push(() => drawn.begin());
    return new Pass(commands, drawn);
  }

  copyTextureToBuffer({ texture, origin }, { buffer, offset = 0, bytesPerRow }, { width, height }) {
    if (origin?.x || origin?.y) refuse("copies from within a picture");
    const gl = this.#gl;
    this.#commands.push(() => {
      gl.bindFramebuffer(gl.FRAMEBUFFER, texture.framebuffer());
      gl.pixelStorei(gl.PACK_ROW_LENGTH, bytesPerRow / 4);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, buffer.bytes, offset);
    });
  }

  finish() {
    return this.#commands;
  }
}

/// What the program calls between the beginning of a pass and its end.
class Pass {
  #commands;
  #drawn;

  constructor(commands, drawn) {
    this.#commands = commands;
    this.#drawn = drawn;
  }

  setPipeline(pipeline) {
    this.#commands.push(() => this.#drawn.use(pipeline));
  }

  setBindGroup(index, group, ...offsets) {
    if (offsets.length) refuse("offsets of a bind group");
    this.#commands.push(() => this.#drawn.bind(index, group));
  }

  setVertexBuffer(slot, buffer, offset = 0) {
    this.#commands.push(() => this.#drawn.vertices(slot, buffer, offset));
  }

  setIndexBuffer(buffer, format, offset = 0) {
    if (format !== "uint32") refuse(`indices as ${format}`);
    this.#commands.push(() => this.#drawn.indices(buffer, offset));
  }

  setViewport(...given) {
    this.#commands.push(() => this.#drawn.viewport(...given));
  }

  setScissorRect(...given) {
    this.#commands.push(() => this.#drawn.scissor(...given));
  }

  draw(count, instances = 1, first = 0, firstInstance = 0) {
    if (firstInstance) refuse("a first instance");
    this.#commands.push(() => this.#drawn.draw(count, instances, first));
  }

  drawIndexed(count, instances = 1, first = 0, base = 0, firstInstance = 0) {
    if (base || firstInstance) refuse("a first vertex or instance of indices");
    this.#commands.push(() => this.#drawn.drawIndexed(count, instances, first));
  }

  end() {
    this.#commands.push(() => this.#drawn.end());
  }
}

/// A pass as it is drawn.
class DrawnPass {
  #gl;
  #color;
  #depth;
  #pipeline = null;
  #groups = [];
  #buffers = [];
  #indexOffset = 0;
  // Whether WebGL is behind what was set.
  #bound = false;
  #pointed = false;
  #enabled = new Set();

  constructor(gl, { colorAttachments, depthStencilAttachment }) {
    if (colorAttachments.length > 1) refuse("several pictures at once");
    this.#gl = gl;
    this.#color = colorAttachments[0];
    this.#depth = depthStencilAttachment;
  }

  #framebuffer() {
    const { view } = this.#color ?? this.#depth;
    return view.framebuffer(this.#color ? this.#depth?.view : null);
  }

  begin() {
    const gl = this.#gl;
    const { width, height } = (this.#color ?? this.#depth).view;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.#framebuffer());
    gl.disable(gl.SCISSOR_TEST);
    gl.depthMask(true);
    if (this.#color?.loadOp === "clear") {
      const { r, g, b, a } = this.#color.clearValue;
      gl.clearBufferfv(gl.COLOR, 0, [r, g, b, a]);
    }
    if (this.#depth?.depthLoadOp === "clear") gl.clearBufferfv(gl.DEPTH, 0, [this.#depth.depthClearValue]);
    gl.enable(gl.SCISSOR_TEST);
    this.scissor(0, 0, width, height);
    this.viewport(0, 0, width, height, 0, 1);
  }

  end() {
    const gl = this.#gl;
    for (const location of this.#enabled) gl.disableVertexAttribArray(location);
    const { view, resolveTarget, storeOp } = this.#color ?? {};
    if (resolveTarget) copy(gl, view.framebuffer(this.#depth?.view), resolveTarget.framebuffer(), view, false);
    // What is not kept need not leave a tiled GPU.
    const gone = [];
    if (storeOp === "discard") gone.push(gl.COLOR_ATTACHMENT0);
    if (this.#depth?.depthStoreOp === "discard") gone.push(gl.DEPTH_ATTACHMENT);
    if (gone.length === 0) return;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.#framebuffer());
    gl.invalidateFramebuffer(gl.FRAMEBUFFER, gone);
  }

  use(pipeline) {
    const gl = this.#gl;
    const { program, cull, front, depth, blend } = pipeline;
    const set = (what, wanted) => (wanted ? gl.enable(what) : gl.disable(what));
    gl.useProgram(program);
    gl.frontFace(front);
    set(gl.CULL_FACE, cull);
    if (cull) gl.cullFace(cull);
    set(gl.DEPTH_TEST, depth);
    if (depth) {
      gl.depthMask(depth.write);
      gl.depthFunc(depth.compare);
    }
    set(gl.POLYGON_OFFSET_FILL, depth?.slope || depth?.bias);
    if (depth) gl.polygonOffset(depth.slope, depth.bias);
    set(gl.BLEND, blend);
    if (blend) gl.blendFuncSeparate(blend[0].from, blend[0].to, blend[1].from, blend[1].to);
    this.#pipeline = pipeline;
    this.#bound = this.#pointed = false;
  }

  bind(index, group) {
    this.#groups[index] = group;
    this.#bound = false;
  }

  vertices(slot, buffer, offset) {
    this.#buffers[slot] = { buffer, offset };
    this.#pointed = false;
  }

  indices(buffer, offset) {
    this.#gl.bindBuffer(this.#gl.ELEMENT_ARRAY_BUFFER, buffer.handle);
    this.#indexOffset = offset;
  }

  viewport(x, y, width, height, near, far) {
    const [left, top] = [Math.round(x), Math.round(y)];
    this.#gl.viewport(left, top, Math.round(x + width) - left, Math.round(y + height) - top);
    this.#gl.depthRange(near, far);
  }

  scissor(x, y, width, height) {
    this.#gl.scissor(x, y, width, height);
  }

  draw(count, instances, first) {
    this.#ready();
    this.#gl.drawArraysInstanced(this.#pipeline.topology, first, count, instances);
  }

  drawIndexed(count, instances, first) {
    const gl = this.#gl;
    this.#ready();
    gl.drawElementsInstanced(this.#pipeline.topology, count, gl.UNSIGNED_INT, this.#indexOffset + 4 * first, instances);
  }

  #ready() {
    if (!this.#bound) this.#bindAll();
    if (!this.#pointed) this.#pointAll();
    this.#bound = this.#pointed = true;
  }

  #bindAll() {
    const gl = this.#gl;
    this.#pipeline.uniforms.forEach(({ group, binding }, place) => {
      const { buffer, offset = 0, size = buffer.size - offset } = this.#groups[group].get(binding);
      gl.bindBufferRange(gl.UNIFORM_BUFFER, place, buffer.handle, offset, size);
    });
    this.#pipeline.textures.forEach(({ group, binding, sampler }, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, this.#groups[group].get(binding).handle);
      gl.bindSampler(unit, sampler && this.#groups[sampler.group].get(sampler.binding).handle);
    });
    // Where textures are written.
    gl.activeTexture(gl.TEXTURE0);
  }

  #pointAll() {
    const gl = this.#gl;
    const before = this.#enabled;
    this.#enabled = new Set();
    this.#pipeline.buffers.forEach((layout, slot) => {
      if (!layout) return;
      const { buffer, offset: start } = this.#buffers[slot];
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer.handle);
      for (const { location, count, type, whole, offset } of layout.attributes) {
        if (whole) gl.vertexAttribIPointer(location, count, type, layout.stride, start + offset);
        else gl.vertexAttribPointer(location, count, type, type === gl.UNSIGNED_BYTE, layout.stride, start + offset);
        gl.vertexAttribDivisor(location, layout.divisor);
        gl.enableVertexAttribArray(location);
        this.#enabled.add(location);
        before.delete(location);
      }
    });
    for (const location of before) gl.disableVertexAttribArray(location);
  }
}

/// Copies a picture of this size to another; several samples become one; turned over, if wanted, top to bottom.
function copy(gl, from, to, { width, height }, over) {
  gl.bindFramebuffer(gl.READ_FRAMEBUFFER, from);
  gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, to);
  gl.disable(gl.SCISSOR_TEST);
  const [bottom, top] = over ? [height, 0] : [0, height];
  gl.blitFramebuffer(0, 0, width, height, 0, bottom, width, top, gl.COLOR_BUFFER_BIT, gl.NEAREST);
}

/// Brings a picture on the canvas.
export function present(gl, texture) {
  copy(gl, texture.framebuffer(), null, texture, true);
}
