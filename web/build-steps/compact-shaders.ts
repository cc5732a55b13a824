// three.js has its shaders as texts with indented lines, which the graphics card does not need.
import type { Plugin } from 'vite';

export function compactShaders(): Plugin {
  return {
    name: 'compact-shaders',
    transform(code, id) {
      if (!id.endsWith('/three.module.js')) return null;
      return { code: code.replace(/\\n(?:\\t)+/g, '\\n'), map: null };
    },
  };
}
