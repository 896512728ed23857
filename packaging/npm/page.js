// The page as a whole: a folder of files for any web server (docs/howto/web.md says which headers it likes).
import { fileURLToPath } from 'node:url';

export const pageFolder = fileURLToPath(new URL('./site/', import.meta.url));
