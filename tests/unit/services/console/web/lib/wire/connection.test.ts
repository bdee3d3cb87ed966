import { socketAddress } from '@page/lib/wire/connection';

const at = (href: string) => new URL(href);

describe('the address of the socket', () => {
  it('lies beside the page and takes the token along', () => {
    expect(socketAddress(at('http://127.0.0.1:8080/'))).toBe('ws://127.0.0.1:8080/ws');
    expect(socketAddress(at('http://host:8081/?token=abc'))).toBe('ws://host:8081/ws?token=abc');
    expect(socketAddress(at('https://host/lukou/index.html'))).toBe('wss://host/lukou/ws');
  });
});
