// The picture as a PNG file, as it stands on the screen.

export function savePicture(layers: readonly HTMLCanvasElement[], name: string): void {
  const sheet = document.createElement('canvas');
  sheet.width = layers[0].width;
  sheet.height = layers[0].height;
  const context = sheet.getContext('2d');
  if (context === null) return;
  for (const layer of layers) context.drawImage(layer, 0, 0);
  sheet.toBlob((blob) => {
    if (blob !== null) saveAs(blob, name);
  }, 'image/png');
}

/** Hands a file to the browser's downloads. */
export function saveAs(content: Blob, name: string): void {
  const address = URL.createObjectURL(content);
  const link = document.createElement('a');
  link.href = address;
  link.download = name;
  link.click();
  // The browser reads it after the click.
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
