// A mesh of the user's, by the file picker or dropped on the page; and what was felt, saved as a file.
import { zipOf } from './zip.js';

const MOST_BYTES = 400e6;

const READ_ME = `What was felt on the page, as palpate reads it:

  palpate recording info forces.csv                       what there is in it
  palpate run scene.toml --replay forces.csv    look again, tick by tick

scene.toml names the body. For a mesh of your own put its file beside it.
`;

export class Files {
  /// `hooks`: open(name, bytes, unit_mm) (a promise), record() -> {csv, toml}, fail(words).
  constructor(parts, hooks) {
    Object.assign(this, { parts, hooks });
    parts.open.addEventListener('click', () => parts.file.click());
    parts.file.addEventListener('change', () => {
      if (parts.file.files.length > 0) this.take(parts.file.files[0]);
      parts.file.value = ''; // so that the same file can be chosen again
    });
    parts.export.addEventListener('click', () => this.save());
    addEventListener('dragover', (event) => {
      event.preventDefault();
      parts.drop.hidden = false;
    });
    addEventListener('dragleave', (event) => {
      if (!event.relatedTarget) parts.drop.hidden = true;
    });
    addEventListener('drop', (event) => {
      event.preventDefault();
      parts.drop.hidden = true;
      if (event.dataTransfer.files.length > 0) this.take(event.dataTransfer.files[0]);
    });
  }

  async take(file) {
    if (file.size > MOST_BYTES) {
      this.hooks.fail(`${file.name}: ${(file.size / 1e6).toFixed(0)} MB is too large; a page can hold at most ${MOST_BYTES / 1e6} MB`);
      return;
    }
    try {
      await this.hooks.open(file.name, await file.arrayBuffer(), Number(this.parts.unit.value));
    } catch (error) {
      this.hooks.fail(error.message);
    }
  }

  async save() {
    try {
      const { csv, toml } = await this.hooks.record();
      if (csv.indexOf('\n') === csv.length - 1) throw new Error('nothing was felt yet; press on the skin first');
      const archive = await zipOf({ 'forces.csv': csv, 'scene.toml': toml, 'README.txt': READ_ME });
      const link = document.createElement('a');
      link.href = URL.createObjectURL(archive);
      link.download = 'palpate-felt.zip';
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    } catch (error) {
      this.hooks.fail(error.message);
    }
  }
}
