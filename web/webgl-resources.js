// Buffers, textures and samplers of WebGPU, by WebGL2 (see webgl.js).

// Of GPUBufferUsage and GPUTextureUsage.
const MAP_READ = 0x1;
const INDEX = 0x10;
const COPY_DST = 0x2;
const TEXTURE_BINDING = 0x4;

/// What WebGPU allows and the page does not use.
export function refuse(what) {
  throw new TypeError(`the page's WebGL does not draw with ${what}`);
}

/// An entry of a table, by WebGPU's word.
export function known(table, word, what) {
  return table[word] ?? refuse(`the ${what} ${word}`);
}

export class Buffer {
  #gl;
  #target;
  #mapped = null;

  constructor(gl, { size, usage, mappedAtCreation = false }) {
    this.#gl = gl;
    this.size = size;
    this.usage = usage;
    // What is read back lies with the program at once.
    if (usage & MAP_READ) {
      this.bytes = new Uint8Array(size);
      return;
    }
    // A buffer of indices is of no other use in WebGL.
    this.#target = usage & INDEX ? gl.ELEMENT_ARRAY_BUFFER : gl.ARRAY_BUFFER;
    this.handle = gl.createBuffer();
    gl.bindBuffer(this.#target, this.handle);
    gl.bufferData(this.#target, size, gl.DYNAMIC_DRAW);
    if (mappedAtCreation) this.#mapped = new ArrayBuffer(size);
  }

  write(offset, data, from, size) {
    // Zero is the rest of the data for WebGL.
    if (size === 0) return;
    this.#gl.bindBuffer(this.#target, this.handle);
    this.#gl.bufferSubData(this.#target, offset, data, from, size);
  }

  async mapAsync() {
    if (this.#gl.isContextLost()) throw new Error("the WebGL context was lost");
    this.#mapped = this.bytes.buffer;
  }

  getMappedRange(offset = 0, size = this.size - offset) {
    if (offset !== 0 || size !== this.size) refuse("a part of a buffer that is mapped");
    return this.#mapped;
  }

  unmap() {
    if (this.handle && this.#mapped) this.write(0, new Uint8Array(this.#mapped), 0, this.size);
    this.#mapped = null;
  }

  destroy() {
    this.#gl.deleteBuffer(this.handle);
    this.handle = this.bytes = this.#mapped = null;
  }
}

/// WebGL's name for a format.
function format(gl, name) {
  const formats = { rgba8unorm: gl.RGBA8, depth24plus: gl.DEPTH_COMPONENT24, depth32float: gl.DEPTH_COMPONENT32F };
  return known(formats, name, "format");
}

export class Texture {
  #gl;
  /// Those that it is the first attachment of, by the other one.
  #framebuffers = new Map();

  constructor(gl, { format: name, size, usage, sampleCount = 1, mipLevelCount = 1 }) {
    if (mipLevelCount !== 1 || (size.depthOrArrayLayers ?? 1) !== 1) refuse("mipmaps or layers");
    this.#gl = gl;
    ({ width: this.width, height: this.height } = size);
    this.isDepth = name.startsWith("depth");
    // What is only drawn to need not be a texture.
    if (usage & (TEXTURE_BINDING | COPY_DST)) {
      if (sampleCount !== 1) refuse("several samples of a texture that is read");
      this.handle = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, this.handle);
      gl.texStorage2D(gl.TEXTURE_2D, 1, format(gl, name), this.width, this.height);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    } else {
      this.surface = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, this.surface);
      if (sampleCount > 1) gl.renderbufferStorageMultisample(gl.RENDERBUFFER, sampleCount, format(gl, name), this.width, this.height);
      else gl.renderbufferStorage(gl.RENDERBUFFER, format(gl, name), this.width, this.height);
    }
  }

  createView() {
    return this;
  }

  /// Rows of red, green, blue and alpha.
  write({ x = 0, y = 0 } = {}, data, { offset = 0, bytesPerRow }, { width, height = 1 }) {
    const gl = this.#gl;
    gl.bindTexture(gl.TEXTURE_2D, this.handle);
    gl.pixelStorei(gl.UNPACK_ROW_LENGTH, (bytesPerRow ?? 4 * width) / 4);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data, offset);
  }

  /// A framebuffer that draws to this and to `other`, if there is one; and whose pixels can be read.
  framebuffer(other = null) {
    const gl = this.#gl;
    let made = this.#framebuffers.get(other);
    if (made === undefined) {
      made = gl.createFramebuffer();
      this.#framebuffers.set(other, made);
      gl.bindFramebuffer(gl.FRAMEBUFFER, made);
      for (const texture of other ? [this, other] : [this]) texture.#attach();
      if (this.isDepth) {
        gl.drawBuffers([gl.NONE]);
        gl.readBuffer(gl.NONE);
      }
    }
    return made;
  }

  #attach() {
    const gl = this.#gl;
    const place = this.isDepth ? gl.DEPTH_ATTACHMENT : gl.COLOR_ATTACHMENT0;
    if (this.handle) gl.framebufferTexture2D(gl.FRAMEBUFFER, place, gl.TEXTURE_2D, this.handle, 0);
    else gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, this.surface);
  }

  destroy() {
    const gl = this.#gl;
    for (const framebuffer of this.#framebuffers.values()) gl.deleteFramebuffer(framebuffer);
    this.#framebuffers.clear();
    if (this.handle) gl.deleteTexture(this.handle);
    if (this.surface) gl.deleteRenderbuffer(this.surface);
    this.handle = this.surface = null;
  }
}

/// WebGL's name for a comparison.
export function comparison(gl, name) {
  const comparisons = { never: gl.NEVER, less: gl.LESS, equal: gl.EQUAL, "less-equal": gl.LEQUAL, greater: gl.GREATER };
  return known({ ...comparisons, "not-equal": gl.NOTEQUAL, "greater-equal": gl.GEQUAL, always: gl.ALWAYS }, name, "comparison");
}

export class Sampler {
  constructor(gl, { addressModeU, addressModeV, magFilter, minFilter, compare }) {
    const addresses = { "clamp-to-edge": gl.CLAMP_TO_EDGE, repeat: gl.REPEAT, "mirror-repeat": gl.MIRRORED_REPEAT };
    const filters = { nearest: gl.NEAREST, linear: gl.LINEAR };
    this.handle = gl.createSampler();
    // Lost, as all is then.
    if (!this.handle) return;
    const set = (name, value) => gl.samplerParameteri(this.handle, name, value);
    set(gl.TEXTURE_WRAP_S, known(addresses, addressModeU ?? "clamp-to-edge", "address mode"));
    set(gl.TEXTURE_WRAP_T, known(addresses, addressModeV ?? "clamp-to-edge", "address mode"));
    set(gl.TEXTURE_MAG_FILTER, known(filters, magFilter ?? "nearest", "filter"));
    set(gl.TEXTURE_MIN_FILTER, known(filters, minFilter ?? "nearest", "filter"));
    if (!compare) return;
    set(gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    set(gl.TEXTURE_COMPARE_FUNC, comparison(gl, compare));
  }
}
