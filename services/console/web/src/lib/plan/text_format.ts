// Reads Protobuf's text format as far as scenarios use it: fields, messages in {} or <>, lists in [], comments, strings.

export interface Field {
  name: string;
  value: string | Field[];
}

export class TextFormatError extends Error {}

const TOKEN = /\s+|#[^\n]*|([{}<>[\]:,;])|"((?:[^"\\\n]|\\.)*)"|'((?:[^'\\\n]|\\.)*)'|([A-Za-z0-9_.+-]+)/y;

interface Token {
  kind: 'sign' | 'text' | 'word';
  text: string;
  line: number;
}

function tokensOf(text: string): Token[] {
  const tokens: Token[] = [];
  let line = 1;
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < text.length) {
    const from = TOKEN.lastIndex;
    const match = TOKEN.exec(text);
    if (match === null) throw new TextFormatError(`line ${line}: "${text[from]}" cannot stand here`);
    if (match[1] !== undefined) tokens.push({ kind: 'sign', text: match[1], line });
    else if (match[2] !== undefined || match[3] !== undefined) {
      tokens.push({ kind: 'text', text: (match[2] ?? match[3]).replace(/\\(.)/g, '$1'), line });
    } else if (match[4] !== undefined) tokens.push({ kind: 'word', text: match[4], line });
    line += match[0].split('\n').length - 1;
  }
  return tokens;
}

/** Throws TextFormatError with the line at which it could not go on. */
export function parseText(text: string): Field[] {
  const reader = new Reader(tokensOf(text));
  const whole = reader.sees('{') ? reader.message() : reader.fields(null);
  reader.expectEnd();
  return whole;
}

class Reader {
  private at = 0;

  constructor(private readonly tokens: readonly Token[]) {}

  sees(sign: string): boolean {
    const token = this.tokens[this.at];
    return token?.kind === 'sign' && token.text === sign;
  }

  expectEnd(): void {
    if (this.at < this.tokens.length) this.fail('the end');
  }

  message(): Field[] {
    const close = this.sees('<') ? '>' : '}';
    if (!this.takes('{') && !this.takes('<')) this.fail('{');
    const fields = this.fields(close);
    if (!this.takes(close)) this.fail(close);
    return fields;
  }

  fields(close: string | null): Field[] {
    const fields: Field[] = [];
    while (this.at < this.tokens.length && (close === null || !this.sees(close))) {
      const name = this.tokens[this.at++];
      if (name.kind !== 'word') {
        --this.at;
        this.fail('the name of a field');
      }
      const colon = this.takes(':');
      if (this.sees('{') || this.sees('<')) fields.push({ name: name.text, value: this.message() });
      else if (!colon) this.fail(':');
      else for (const value of this.values()) fields.push({ name: name.text, value });
      if (!this.takes(',')) this.takes(';');
    }
    return fields;
  }

  private values(): (string | Field[])[] {
    if (!this.takes('[')) return [this.value()];
    const values: (string | Field[])[] = [];
    while (!this.takes(']')) {
      values.push(this.value());
      if (!this.takes(',') && !this.sees(']')) this.fail(', or ]');
    }
    return values;
  }

  private value(): string | Field[] {
    if (this.sees('{') || this.sees('<')) return this.message();
    const token = this.tokens[this.at];
    if (token === undefined || token.kind === 'sign') this.fail('a value');
    ++this.at;
    return token.text;
  }

  private takes(sign: string): boolean {
    if (!this.sees(sign)) return false;
    ++this.at;
    return true;
  }

  private fail(wanted: string): never {
    const token = this.tokens[this.at];
    const last = this.tokens[this.tokens.length - 1];
    const where = token === undefined ? `at the end (line ${last?.line ?? 1})` : `line ${token.line}: "${token.text}"`;
    throw new TextFormatError(`${where}; expected ${wanted}`);
  }
}
