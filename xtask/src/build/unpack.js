      // What a host would serve beside the page is packed inside it, seven bits a character; a letter beyond ASCII is in the place of a
      // character that a file cannot keep.
      function packed(name) {
        const text = document.getElementById(`packed-${name}`).textContent;
        const bytes = new Uint8Array((text.length * 7) >> 3);
        let [held, bits, at] = [0, 0, 0];
        for (let k = 0; k < text.length; k++) {
          held = ((held & 127) << 7) | (text.charCodeAt(k) & 127);
          bits += 7;
          if (bits >= 8) bytes[at++] = held >> (bits -= 8);
        }
        return bytes;
      }
      const unpacked = (name) => new Response(new Blob([packed(name)]).stream().pipeThrough(new DecompressionStream("gzip")));

      /// The address of each module; it comes after those that it imports.
      function linked(modules) {
        const parts = {};
        for (const [name, source] of modules) {
          const text = source.replace(/\b(from|import)(\s*\(?\s*)"\.\/([\w-]+\.js)"/g, (_, word, space, other) => `${word}${space}"${parts[other]}"`);
          parts[name] = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
        }
        return parts;
      }

      /// Runs in a worker: imports its module, and only then tells it what it has been told.
      function work(parts, name) {
        const told = [];
        const hold = (event) => told.push(event.data);
        addEventListener("message", hold);
        import(parts[name]).then(() => {
          removeEventListener("message", hold);
          for (const data of told) dispatchEvent(new MessageEvent("message", { data }));
        }).catch((error) => postMessage({ failed: String(error) }));
      }

      async function show(name) {
        const html = await unpacked(name).text();
        document.open();
        // To where the address leads, once all is there: the browser looked for it before.
        addEventListener("load", () => location.hash && location.replace(location.hash));
        document.write(html);
        document.close();
      }
      async function start() {
        globalThis.centrodeProgram = Promise.resolve(unpacked("program"));
        const modules = JSON.parse(await unpacked("modules").text());
        // A worker of a file on a disk may import what it made itself, and nothing that the page made.
        globalThis.centrodeWorker = (name) => {
          const script = `${linked}\n${work}\nwork(linked(${JSON.stringify(modules)}), ${JSON.stringify(name)});`;
          return new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
        };
        await import(linked(modules)["loader.js"]);
      }
      const old = () => centrodeCannotLoad("This browser is too old", "Please open the file in a current Chrome, Edge, Firefox or Safari.");
      if (!globalThis.DecompressionStream) old();
      else (["?theory", "?licences"].includes(location.search) ? show(location.search.slice(1)) : start()).catch((error) => centrodeCannotLoad("The page could not be unpacked", String(error)));
