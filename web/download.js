// Counts the bytes of the program as they come.

/// What is fetched (a promise of a response) as a wasm response that can be compiled while it arrives.
///
/// What a stream hands out is already decompressed, so it is counted against `total`, the size that the build
/// wrote into the page: Content-Length may be missing, or be that of the compressed body.
export async function download(fetched, total, onProgress) {
  const response = await fetched;
  if (!response.ok) {
    throw new Error(`${new URL(response.url).pathname}: the server answered ${response.status} ${response.statusText}`);
  }
  // Its own content type, because some static hosts send none for wasm.
  const headers = { "Content-Type": "application/wasm" };
  if (!response.body) return new Response(await response.arrayBuffer(), { headers });

  let received = 0;
  const reader = response.body.getReader();
  const counted = new ReadableStream({
    async pull(controller) {
      const { done, value } = await reader.read();
      if (done) {
        onProgress(received, received);
        controller.close();
        return;
      }
      received += value.byteLength;
      onProgress(received, total);
      controller.enqueue(value);
    },
    cancel: (reason) => reader.cancel(reason),
  });
  return new Response(counted, { headers });
}
