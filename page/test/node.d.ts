// As much of node's own modules as the tests use: its types are no dependency of the page.

declare module "node:test" {
  type Body = (context: { skip: (why: string) => void }) => void | Promise<void>;
  export function test(name: string, body: Body): Promise<void>;
  export const mock: {
    timers: {
      enable: (options: { apis: ("setTimeout" | "setInterval")[] }) => void;
      tick: (milliseconds: number) => void;
      reset: () => void;
    };
  };
}

declare module "node:assert/strict" {
  const assert: {
    (value: unknown, message?: string): asserts value;
    equal: (actual: unknown, expected: unknown, message?: string) => void;
    notEqual: (actual: unknown, expected: unknown, message?: string) => void;
    deepEqual: (actual: unknown, expected: unknown, message?: string) => void;
    notDeepEqual: (actual: unknown, expected: unknown, message?: string) => void;
    match: (actual: string, pattern: RegExp, message?: string) => void;
    doesNotMatch: (actual: string, pattern: RegExp, message?: string) => void;
    rejects: (promise: Promise<unknown>) => Promise<void>;
  };
  export default assert;
}

declare module "node:fs" {
  export function readFileSync(path: string, encoding: "utf8"): string;
}

declare const process: { env: { [name: string]: string | undefined }; cwd: () => string };
