"""A running `morsel serve` and requests to it, proper and improper."""

import http.client
import json
import re
import signal
import socket
import subprocess
import urllib.parse

import cli

PATIENCE = 120  # seconds: the machine that runs the tests may be busy


class Server:
    """Serves `database` until it is closed."""

    def __init__(self, folder, database, *arguments, token=None):
        self.process = subprocess.Popen(
            [cli.MORSEL, "serve", "--database", database, "--port", "0", *arguments], cwd=folder,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            preexec_fn=cli.obey_signals)
        if token:
            self.process.stdin.write(token + "\n")
            self.process.stdin.flush()
        self.greeting = self.process.stdout.readline()
        self.port = int(re.search(r":(\d+)/", self.greeting).group(1))
        self.host = f"127.0.0.1:{self.port}"

    def stop(self, how=signal.SIGINT):
        """Returns the exit status and standard error."""
        if self.process.poll() is None:
            self.process.send_signal(how)
        status = self.process.wait(timeout=PATIENCE)
        errors = self.process.stderr.read()
        for stream in (self.process.stdin, self.process.stdout, self.process.stderr):
            stream.close()
        return status, errors

    def ask(self, method, path, body=None, headers=None, **parameters):
        """Returns status, headers and body."""
        if parameters:
            path += "?" + urllib.parse.urlencode(parameters)
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        try:
            connection.request(method, path, body, headers or {})
            response = connection.getresponse()
            return response.status, response.headers, response.read()
        finally:
            connection.close()

    def get(self, path, **parameters):
        """The JSON of an answer that must be there."""
        status, _, body = self.ask("GET", path, **parameters)
        assert status == 200, (status, body)
        return json.loads(body)

    def send(self, name, content, **headers):
        headers = {"Content-Type": "application/octet-stream", **headers}
        return self.ask("POST", "/api/uploads?" + urllib.parse.urlencode({"name": name}), content,
                        headers)

    def events(self, path, **parameters):
        """The JSON of all events until the last."""
        status, headers, body = self.ask("GET", path, **parameters)
        assert (status, headers["Content-Type"]) == (200, "text/event-stream")
        events = [event for event in body.decode().split("\n\n") if event.startswith("data: ")]
        return [json.loads(event[len("data: "):]) for event in events]

    def follow(self, upload):
        """All states of an upload."""
        return self.events("/api/upload/events", id=upload)

    def hand_in(self, name, content):
        """Sends a file and waits; returns its last state."""
        status, _, body = self.send(name, content)
        assert status == 202, (status, body)
        return self.follow(json.loads(body)["id"])[-1]

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE)

    def raw(self, sent):
        """What the server says to these bytes until it closes the connection."""
        with self.connect() as connection:
            try:
                connection.sendall(sent)
                connection.shutdown(socket.SHUT_WR)
            except OSError:
                pass  # it has heard enough
            answer = b""
            try:
                while chunk := connection.recv(65536):
                    answer += chunk
            except ConnectionError:
                pass
            return answer
