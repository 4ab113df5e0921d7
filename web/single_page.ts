// Turns the build into one page: script and style go inline, and a content-security policy allows
// these two and nothing else, no network above all.
import { createHash } from 'node:crypto';
import type { Plugin } from 'vite';

const hash = (text: string) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

// Within a script or style element no closing tag of it and no comment may be spelt.
const harmless = (text: string) => text.replace(/<(?=\/(?:script|style)|!--)/gi, '\\x3C');

/** `name`: of the page. One that is opened from the disk reaches nothing, the app its own server. */
export function singlePage(name: string): Plugin {
  const sources =
    name === 'app.html' ? "connect-src 'self'; img-src 'self' data: blob:; " : 'img-src data:; ';
  return {
    name: 'single-page',
    enforce: 'post',
    generateBundle(_, bundle) {
      let page = '';
      let script = '';
      let style = '';
      for (const file of Object.values(bundle)) {
        if (file.type === 'chunk') script += file.code;
        else if (file.fileName.endsWith('.css')) style += String(file.source);
        else if (file.fileName.endsWith('.html')) page = String(file.source);
        else throw new Error(`${file.fileName}: has no place in a single page`);
      }
      const code = harmless(script);
      const policy =
        `default-src 'none'; script-src ${hash(code)}; style-src ${hash(style)}; ` +
        `${sources}base-uri 'none'; form-action 'none'; ` +
        "require-trusted-types-for 'script'; trusted-types 'none'";
      page = page
        .replace(/\s*<script type="module"[^>]*><\/script>/, '')
        .replace(/\s*<link rel="stylesheet"[^>]*>/, '')
        .replace(
          '<meta charset="utf-8" />',
          () => `<meta charset="utf-8" />
    <meta http-equiv="Content-Security-Policy" content="${policy}" />`,
        )
        .replace('</head>', () => `<style>${style}</style>\n  </head>`)
        .replace('</body>', () => `<script type="module">${code}</script>\n  </body>`);
      for (const name of Object.keys(bundle)) delete bundle[name];
      this.emitFile({ type: 'asset', fileName: name, source: page });
    },
  };
}
