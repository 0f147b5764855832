      // What a host would serve beside the page is packed inside it.
      const packed = (name) => Uint8Array.from(atob(document.getElementById(`packed-${name}`).textContent), (c) => c.charCodeAt(0));
      const unpacked = (name) => new Response(new Blob([packed(name)]).stream().pipeThrough(new DecompressionStream("gzip")));
      async function showTheory() {
        const html = await unpacked("theory").text();
        document.open();
        document.write(html);
        document.close();
        document.getElementById(location.hash.slice(1))?.scrollIntoView();
      }
      async function start() {
        globalThis.centrodeProgram = Promise.resolve(unpacked("program"));
        globalThis.centrodeParts = {};
        // Each comes after those that it imports.
        for (const [name, source] of JSON.parse(await unpacked("modules").text())) {
          const linked = source.replace(/\b(from|import)(\s*\(?\s*)"\.\/([\w-]+\.js)"/g, (_, word, space, other) => `${word}${space}"${centrodeParts[other]}"`);
          centrodeParts[name] = URL.createObjectURL(new Blob([linked], { type: "text/javascript" }));
        }
        await import(centrodeParts["loader.js"]);
      }
      const old = () => centrodeCannotLoad("This browser is too old", "Please open the file in a current Chrome, Edge, Firefox or Safari.");
      if (!globalThis.DecompressionStream) old();
      else (location.search === "?theory" ? showTheory() : start()).catch((error) => centrodeCannotLoad("The page could not be unpacked", String(error)));
