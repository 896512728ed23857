// press.html of an installed npm package in a headless Chromium: prints the force as press.mjs does. Exit code 77: no browser.
//
//   node packaging/release/press_in_browser.mjs FOLDER     FOLDER has node_modules/palpate
import { resolve } from 'node:path';
import { Browser, findBrowser } from '../../engine/web/tests/browser.mjs';
import { serve } from '../../engine/web/tests/server.mjs';

if (!findBrowser()) process.exit(77);
const server = await serve(resolve(process.argv[2]), { isolated: false });
const browser = await Browser.launch();
try {
  const tab = await browser.open(`${server.url}node_modules/palpate/examples/press.html`);
  const force = await tab.until('document.body.dataset.force', 60);
  const words = await tab.until("(/N$/.test(document.querySelector('#felt').textContent) && document.querySelector('#felt').textContent)", 10);
  console.log(`${words}\nforce ${force} N`);
  if (tab.complaints.length > 0) throw new Error(tab.complaints.join('; '));
} finally {
  await browser.close();
  server.close();
}
