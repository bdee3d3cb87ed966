// What leaves the page: the picture as a PNG file, as it stands on the screen, other files, and the clipboard.

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

/** Browsers give the clipboard to pages of this host or of https alone; elsewhere a field that is copied does. */
export async function copyText(text: string): Promise<void> {
  if (navigator.clipboard !== undefined) return navigator.clipboard.writeText(text);
  const field = document.createElement('textarea');
  field.value = text;
  document.body.append(field);
  field.select();
  document.execCommand('copy');
  field.remove();
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
