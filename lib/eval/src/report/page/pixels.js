// Decodes pixels from the page's data.

/** Decodes base64 and decompresses the bytes [RFC 1950]. */
async function unpackBytes(text) {
  const binary = atob(text);
  const compressed = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) {
    compressed[i] = binary.charCodeAt(i);
  }
  const stream = new Blob([compressed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Decodes red, green and blue [nit] from planes of RGB9E5. */
async function unpackImage(text, scale) {
  const planes = await unpackBytes(text);
  const count = planes.length / 4;
  const powers = Float64Array.from({ length: 32 }, (_, exponent) => 2 ** (exponent - 24) / scale);
  const rgb = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) {
    const packed = planes[i] | planes[count + i] << 8 | planes[2 * count + i] << 16 | planes[3 * count + i] << 24;
    const power = powers[packed >>> 27];
    rgb[3 * i] = (packed & 511) * power;
    rgb[3 * i + 1] = (packed >>> 9 & 511) * power;
    rgb[3 * i + 2] = (packed >>> 18 & 511) * power;
  }
  return rgb;
}
