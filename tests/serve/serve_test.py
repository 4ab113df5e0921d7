#!/usr/bin/env python3
"""Tests of `morsel serve`. Usage: PYTHONPATH=tests/cli serve_test.py MORSEL"""

import csv
import io
import json
import pathlib
import shutil
import signal
import subprocess
import tempfile

import jsonschema

import cli
import shapes
from client import Server

TOKEN = "correct-horse-battery"
API = json.loads((cli.PROJECT / "docs" / "openapi.json").read_text(encoding="utf-8"))


def stretched(points, x, y):
    return [(x * p[0], y * p[1], p[2]) for p in points]


class ServeTest(cli.CliTest):
    """One database and server for all tests of a class."""

    arguments = ()
    token = None

    @classmethod
    def setUpClass(cls):
        cls.home = pathlib.Path(tempfile.mkdtemp(prefix="morsel-serve-"))
        cls.addClassCleanup(shutil.rmtree, cls.home)
        balls, _ = shapes.octahedron_sphere((0, 0, 0), 4)
        for name, points in {
                "bells/a": shapes.dumbbell(3000), "bells/b": shapes.dumbbell(3000, 7),
                "balls/round": balls, "balls/long": stretched(balls, 3, 1),
                "flat & <odd>/ü": stretched(balls, 4, 3)}.items():
            path = cls.home / f"{name}.xyz"
            path.parent.mkdir(exist_ok=True)
            path.write_text(shapes.xyz(points))
        subprocess.run([cli.MORSEL, "index", "--database", "s.db", "--class", "folder", "--tag",
                        "made", "bells", "balls", "flat & <odd>"], cwd=cls.home, check=True,
                       capture_output=True)
        cls.server = Server(cls.home, "s.db", *cls.arguments, token=cls.token)
        cls.addClassCleanup(cls.check_end)

    @classmethod
    def check_end(cls):
        status, errors = cls.server.stop()
        assert (status, errors) == (cli.DONE, ""), (status, errors)

    def morsel(self, *arguments):
        done = subprocess.run([cli.MORSEL, *arguments], cwd=self.home, check=True,
                              capture_output=True, text=True)
        return done.stdout

    def refused(self, answer, status, pattern):
        self.assertEqual(answer[0], status, answer)
        self.assertEqual(answer[1]["Content-Type"], "application/json")
        self.assertRegex(json.loads(answer[2])["error"], pattern)

    def works(self):
        self.assertEqual(self.server.get("/api/database")["name"], "s.db")


class Answers(ServeTest):
    def check_schema(self, answer, method, path):
        """The answer is one of those that the document promises."""
        status, headers, body = answer
        promised = API["paths"][path][method]["responses"]
        self.assertIn(str(status), promised, (method, path, body))
        content = promised[str(status)].get("content", {})
        if not content:
            self.assertEqual(body, b"")
            return
        kind = headers["Content-Type"].split(";")[0]
        self.assertIn(kind, content)
        if kind == "application/json":
            schema = {**content[kind]["schema"], "components": API["components"]}
            jsonschema.validate(json.loads(body), schema)

    def test_every_address_answers_as_documented(self):
        state = self.server.hand_in("bell.xyz", (self.home / "bells/a.xyz").read_bytes())
        self.assertEqual(state["stage"], "done", state)
        stored = {"name": "bells/a.xyz"}
        upload = {"upload": state["id"]}
        asked = {
            "/": [{}], "/api/database": [{}],
            "/api/shapes": [{}, {"text": "BELL", "class": "bells", "offset": 1, "limit": 1},
                            {"limit": 0}, {"offset": "x"}],
            "/api/shape": [stored, {}, {"name": "none"}],
            "/api/thumbnail": [stored, {}, {"name": "none"}],
            "/api/search": [stored, upload, {**stored, "top": 2}, {"name": "none"}, {"upload": "0"},
                            {**stored, **upload}, {**stored, "top": 101}],
            "/api/picture": [stored, upload, {}, {"upload": "../s.db"}],
            "/api/parts": [stored, upload, {}, {"name": "none"}],
            "/api/match": [{**stored, "with": "balls/round.xyz"}, {**upload, "with": "bells/b.xyz"},
                           stored, {**stored, "with": "none"}],
            "/api/matrix": [{}, {"class": "balls"}, {"text": "nothing has this"}],
            "/api/matrix/events": [{}, {"class": "balls", "text": "none"}, {"text": "x" * 2049}],
            "/api/upload": [{"id": state["id"]}, {"id": "0"}, {}],
            "/api/upload/events": [{"id": state["id"]}, {"id": "0"}, {}],
        }
        documented = {path for path, methods in API["paths"].items() if "get" in methods}
        self.assertEqual(documented, set(asked))
        for path, all_parameters in asked.items():
            for parameters in all_parameters:
                self.check_schema(self.server.ask("GET", path, **parameters), "get", path)
        for sent in ('{"token": ""}', "nonsense", "[]", '{"token": 5}'):
            self.check_schema(self.server.ask("POST", "/api/session", sent), "post", "/api/session")
        self.check_schema(self.server.send("a.xyz", b"0 0 0\n"), "post", "/api/uploads")
        self.check_schema(self.server.ask("POST", "/api/uploads?name=a.xyz", b"0 0 0\n"), "post",
                          "/api/uploads")
        for parameters in ({"id": state["id"]}, {"id": "0"}):
            self.check_schema(self.server.ask("DELETE", "/api/upload", **parameters), "delete",
                              "/api/upload")
        self.assertEqual(self.server.ask("GET", "/api/nothing")[0], 404)
        self.assertEqual(self.server.ask("PUT", "/api/shapes", b"x")[0], 404)

    def test_searches_are_those_of_the_command_line(self):
        for name in ("bells/a.xyz", "flat & <odd>/ü.xyz"):
            said = json.loads(self.morsel("search", "--database", "s.db", name, "--json"))["hits"]
            hits = self.server.get("/api/search", name=name)["hits"]
            self.assertEqual([{key: hit[key] for key in hits[0]} for hit in said], hits)
            for hit in said:
                match = self.server.get("/api/match", name=name, **{"with": hit["name"]})
                for key in ("score", "mirrored", "target_from_source", "matched",
                            "unmatched_target", "unmatched_source"):
                    self.assertEqual(match[key], hit[key])
        file = shapes.xyz(shapes.dumbbell(3500, 11))
        (self.home / "new.xyz").write_text(file)
        said = json.loads(self.morsel("search", "--database", "s.db", "new.xyz", "--json"))["hits"]
        state = self.server.hand_in("new.xyz", file.encode())
        hits = self.server.get("/api/search", upload=state["id"])["hits"]
        self.assertEqual([{key: hit[key] for key in hits[0]} for hit in said], hits)

    def test_the_score_is_what_its_terms_say(self):
        match = self.server.get("/api/match", name="bells/a.xyz", **{"with": "balls/long.xyz"})
        distance = sum(term["weight"] * term["distance"] for term in match["terms"])
        self.assertAlmostEqual(match["score"], 2.718281828459045 ** -distance, 9)

    def test_the_matrix_is_that_of_the_command_line(self):
        self.morsel("matrix", "--database", "s.db", "--output", "m.csv")
        rows = list(csv.reader(io.StringIO((self.home / "m.csv").read_text(encoding="utf-8"))))
        matrix = self.server.get("/api/matrix")
        self.assertEqual([shape["name"] for shape in matrix["shapes"]], rows[0][1:])
        for row, said in zip(matrix["scores"], rows[1:]):
            self.assertEqual([f"{score:.6f}" for score in row], said[1:len(row) + 1])
        *shares, last = self.server.events("/api/matrix/events")
        self.assertEqual(last, matrix)
        fractions = [share["fraction"] for share in shares]
        self.assertEqual(fractions, sorted(fractions))
        part = self.server.events("/api/matrix/events", text="BELL")[-1]
        self.assertEqual(part, self.server.get("/api/matrix", **{"class": "bells"}))

    def test_shapes_are_found_by_text_and_class(self):
        def names(**parameters):
            answer = self.server.get("/api/shapes", **parameters)
            self.assertEqual(answer["total"], len(answer["shapes"]))
            return [shape["name"] for shape in answer["shapes"]]

        self.assertEqual(len(names()), 5)
        self.assertEqual(names(text="ROUND"), ["balls/round.xyz"])
        self.assertEqual(names(text="bells"), ["bells/a.xyz", "bells/b.xyz"])
        self.assertEqual(len(names(text="made")), 5)
        self.assertEqual(names(**{"class": "flat & <odd>"}), ["flat & <odd>/ü.xyz"])
        page = self.server.get("/api/shapes", offset=1, limit=2)
        self.assertEqual((page["total"], len(page["shapes"])), (5, 2))

    def test_thumbnails_are_sent_once(self):
        status, headers, body = self.server.ask("GET", "/api/thumbnail", name="bells/a.xyz")
        self.assertEqual((status, headers["Content-Type"], body[:4]), (200, "image/png", b"\x89PNG"))
        again = self.server.ask("GET", "/api/thumbnail", headers={"If-None-Match": headers["ETag"]},
                                name="bells/a.xyz")
        self.assertEqual((again[0], again[2]), (304, b""))

    def test_changes_of_the_database_are_seen(self):
        (self.home / "later.xyz").write_text(shapes.xyz(shapes.dumbbell(1500, 5)))
        self.morsel("index", "--database", "s.db", "later.xyz")
        try:
            self.assertEqual(self.server.get("/api/database")["shapes"], 6)
            hits = self.server.get("/api/search", name="later.xyz")["hits"]
            self.assertEqual((hits[0]["name"], len(hits)), ("later.xyz", 6))
        finally:
            self.morsel("remove", "--database", "s.db", "later.xyz")
        self.assertEqual(len(self.server.get("/api/search", name="bells/a.xyz")["hits"]), 5)


class Uploading(ServeTest):
    def test_progress_grows_until_it_is_done(self):
        _, _, body = self.server.send("c:\\folder\\new.xyz",
                                      (self.home / "bells/b.xyz").read_bytes())
        states = self.server.follow(json.loads(body)["id"])
        self.assertEqual(states[-1]["stage"], "done")
        self.assertEqual(states[-1]["name"], "new.xyz")
        self.assertRegex(states[-1]["message"], "part")
        fractions = [state["fraction"] for state in states]
        self.assertEqual(fractions, sorted(fractions))

    def test_bad_files_are_named_and_nothing_of_the_host(self):
        bad = cli.PROJECT / "tests" / "corpus" / "bad"
        files = sorted(path for path in bad.iterdir() if path.suffix in (".ply", ".gltf", ".glb"))
        for path in [*files, bad / "unknown.bin"]:
            state = self.server.hand_in(f"../../{path.name}", path.read_bytes())
            self.assertEqual(state["stage"], "failed", (path.name, state))
            self.assertTrue(state["message"].startswith(path.name), state)
            self.assertNotRegex(state["message"], r"\.\./|/tmp|/home", state)
        flat = self.server.hand_in("flat.xyz", shapes.xyz(shapes.plane()).encode())
        self.assertRegex(flat["message"], "plane")
        self.assertEqual(self.server.hand_in("empty.ply", b"")["stage"], "failed")

    def test_no_other_file_is_read_for_an_upload(self):
        (self.home / "secret.bin").write_bytes(bytes(12) + b"\0\0\x80\x3f" * 6)
        document = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
                    "nodes": [{"mesh": 0}],
                    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3,
                                   "type": "VEC3"}],
                    "bufferViews": [{"buffer": 0, "byteLength": 36}],
                    "buffers": [{"byteLength": 36, "uri": "secret.bin"}]}
        state = self.server.hand_in("sly.gltf", json.dumps(document).encode())
        self.assertEqual(state["stage"], "failed")
        self.assertRegex(state["message"], "another file")

    def test_uploads_can_be_cancelled(self):
        _, _, body = self.server.send("long.xyz", shapes.xyz(shapes.dumbbell(60000)).encode())
        upload = json.loads(body)["id"]
        self.assertEqual(self.server.ask("DELETE", "/api/upload", id=upload)[0], 204)
        self.assertEqual(self.server.follow(upload)[-1]["stage"], "cancelled")
        self.assertEqual(self.server.ask("GET", "/api/parts", upload=upload)[0], 404)
        # Half a file and gone.
        head = (f"POST /api/uploads?name=a.xyz HTTP/1.1\r\nHost: {self.server.host}\r\n"
                "Content-Type: application/octet-stream\r\nContent-Length: 1000\r\n\r\n")
        self.server.raw(head.encode() + b"1 2 3\n")
        self.works()

    def test_only_so_many_wait(self):
        file = shapes.xyz(shapes.dumbbell(40000)).encode()
        answers = [self.server.send(f"{i}.xyz", file) for i in range(12)]
        taken = [json.loads(answer[2])["id"] for answer in answers if answer[0] == 202]
        turned_away = [answer for answer in answers if answer[0] != 202]
        for upload in taken:
            self.server.ask("DELETE", "/api/upload", id=upload)
        self.assertGreaterEqual(len(taken), 6)
        self.assertGreater(len(turned_away), 0)
        for answer in turned_away:
            self.refused(answer, 503, "waiting")
            self.assertTrue(answer[1]["Retry-After"])
        for upload in taken:
            self.server.follow(upload)


class Limits(ServeTest):
    arguments = ("--most-upload", "1")

    def test_large_files_are_refused(self):
        large = b"0 0 0\n" * 400_000
        self.refused(self.server.send("large.xyz", large), 413, "at most 1 MB")
        # Without a length in its head.
        self.refused(self.server.send("large.xyz", iter([large[:600_000]] * 4)), 413, "at most 1 MB")
        self.works()

    def test_wrong_bodies_are_refused(self):
        self.refused(self.server.ask("POST", "/api/uploads?name=a.xyz", b"0 0 0\n",
                                     {"Content-Type": "text/plain"}), 415, "octet-stream")
        self.refused(self.server.send("a.xyz", b"0 0 0\n", **{"Content-Encoding": "gzip"}), 400,
                     "as it is")
        self.refused(self.server.ask("POST", "/api/uploads", b"", {
            "Content-Type": "application/octet-stream"}), 400, "name is missing")
        self.refused(self.server.ask("POST", "/api/session", b"x" * 100_000), 400, "token")
        self.works()


class Strangers(ServeTest):
    def test_other_sites_are_refused(self):
        for headers in ({"Origin": "http://evil.example"}, {"Origin": "null"},
                        {"Origin": f"http://127.0.0.1:{self.server.port + 1}"},
                        {"Sec-Fetch-Site": "cross-site"}, {"Sec-Fetch-Site": "same-site"}):
            for path in ("/api/database", "/api/thumbnail?name=bells/a.xyz"):
                self.refused(self.server.ask("GET", path, headers=headers), 403, "other sites")
            self.refused(self.server.send("a.xyz", b"0 0 0\n", **headers), 403, "other sites")
        for headers in ({"Origin": f"http://{self.server.host}", "Sec-Fetch-Site": "same-origin"},
                        {"Sec-Fetch-Site": "none"}):
            self.assertEqual(self.server.ask("GET", "/api/database", headers=headers)[0], 200)

    def test_other_names_are_refused(self):
        for host in ("evil.example", f"evil.example:{self.server.port}", "127.0.0.1", ""):
            for path in ("/", "/api/database"):
                self.refused(self.server.ask("GET", path, headers={"Host": host}), 403, "name")
        for host in (f"localhost:{self.server.port}", f"LOCALHOST:{self.server.port}"):
            self.assertEqual(self.server.ask("GET", "/", headers={"Host": host})[0], 200)

    def test_no_path_of_the_host_is_reached(self):
        secret = self.home / "secret.txt"
        secret.write_text("top secret")
        for path in ("/secret.txt", "/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt",
                     f"/{secret}", f"//{secret}", "/api/../secret.txt", "/s.db", "/.", "/%00",
                     "/api/thumbnail/../../s.db"):
            status, _, body = self.server.ask("GET", path)
            self.assertEqual(status, 404, path)
            self.assertNotIn(b"secret", body)
        for name in ("../secret.txt", str(secret), "s.db", "secret.txt", "\0"):
            for path in ("/api/shape", "/api/thumbnail", "/api/parts", "/api/picture",
                         "/api/search"):
                self.refused(self.server.ask("GET", path, name=name), 404, "no shape")
        everything = self.server.ask("GET", "/api/shapes")[2]
        everything += self.server.ask("GET", "/api/database")[2]
        self.assertNotIn(str(self.home).encode(), everything)

    def test_the_page_runs_only_its_own_script(self):
        _, headers, body = self.server.ask("GET", "/")
        policy = headers["Content-Security-Policy"]
        for rule in ("default-src 'none'", "script-src 'sha256-", "style-src 'sha256-",
                     "connect-src 'self'", "frame-ancestors 'none'", "base-uri 'none'"):
            self.assertIn(rule, policy)
        self.assertNotIn("unsafe", policy)
        self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
        self.assertEqual(headers["Cross-Origin-Resource-Policy"], "same-origin")
        self.assertNotIn(b"http://", body.split(b"<script")[0])

    def test_malformed_requests_disturb_nobody(self):
        host = f"Host: {self.server.host}\r\n".encode()
        for sent in (b"", b"\r\n\r\n", b"nonsense\r\n\r\n", b"GET\r\n\r\n", bytes(range(256)) * 50,
                     b"GET / HTTP/9.9\r\n" + host + b"\r\n",
                     b"GET /" + b"a" * 20_000 + b" HTTP/1.1\r\n" + host + b"\r\n",
                     b"GET / HTTP/1.1\r\n" + host + b"X: " + b"a" * 20_000 + b"\r\n\r\n",
                     b"GET / HTTP/1.1\r\n" + host + b"X: y\r\n" * 50_000 + b"\r\n",
                     b"GET / HTTP/1.1\r\n" + host + b"Range: bytes=5-2\r\n\r\n",
                     b"GET /api/shape?name=%zz%f HTTP/1.1\r\n" + host + b"\r\n",
                     b"POST /api/uploads?name=a HTTP/1.1\r\n" + host +
                     b"Content-Type: application/octet-stream\r\nContent-Length: -5\r\n\r\nx",
                     b"POST /api/uploads?name=a HTTP/1.1\r\n" + host +
                     b"Content-Type: application/octet-stream\r\n"
                     b"Transfer-Encoding: chunked\r\n\r\nfffffffffffffff\r\nx",
                     b"POST /api/session HTTP/1.1\r\n" + host + b"Content-Length: 5\r\n"
                     b"Content-Length: 50\r\n\r\nhello"):
            answer = self.server.raw(sent)
            self.assertNotIn(b"HTTP/1.1 202", answer, sent[:80])
            self.assertNotIn(b"HTTP/1.1 500", answer, sent[:80])
            self.works()

    def test_a_refused_body_is_not_the_next_request(self):
        inner = f"GET /api/database HTTP/1.1\r\nHost: {self.server.host}\r\n\r\n"
        answer = self.server.raw(
            f"POST /api/uploads?name=a HTTP/1.1\r\nHost: {self.server.host}\r\nContent-Type: "
            f"text/plain\r\nContent-Length: {len(inner)}\r\n\r\n{inner}{inner}".encode())
        self.assertEqual(answer.count(b"HTTP/1.1 "), 1, answer)

    def test_slow_clients_block_nobody(self):
        slow = [self.server.connect() for _ in range(100)]
        try:
            for i, connection in enumerate(slow):
                part = [b"G", f"GET / HTTP/1.1\r\nHost: {self.server.host}\r\nX: ".encode(),
                        f"POST /api/uploads?name=a.xyz HTTP/1.1\r\nHost: {self.server.host}\r\n"
                        "Content-Type: application/octet-stream\r\nContent-Length: 9999\r\n\r\n1 "
                        .encode()][i % 3]
                connection.sendall(part)
            for _ in range(5):
                self.works()
            self.assertEqual(self.server.hand_in("a.xyz", (self.home / "bells/a.xyz").read_bytes())
                             ["stage"], "done")
        finally:
            for connection in slow:
                connection.close()
        self.works()

    def test_more_connections_than_are_taken_are_told_so(self):
        crowd = [self.server.connect() for _ in range(600)]
        for connection in crowd:
            connection.close()
        self.works()


class Tokens(ServeTest):
    arguments = ("--token", "-")
    token = TOKEN

    def test_nothing_is_told_without_the_token(self):
        self.assertEqual(self.server.ask("GET", "/")[0], 200)
        self.assertNotIn(TOKEN.encode(), self.server.ask("GET", "/")[2])
        wrong = ({}, {"Authorization": "Bearer wrong-wrong-wrong-wrong"},
                 {"Authorization": "Bearer "}, {"Authorization": f"Basic {TOKEN}"},
                 {"Cookie": f"morsel-{self.server.port}={TOKEN}"},
                 {"Cookie": f"morsel-{self.server.port}="})
        for headers in wrong:
            for path in ("/api/database", "/api/shapes", "/api/thumbnail?name=bells/a.xyz"):
                self.refused(self.server.ask("GET", path, headers=headers), 401, "token")
            self.refused(self.server.send("a.xyz", b"0 0 0\n", **headers), 401, "token")

    def test_the_token_opens(self):
        bearer = {"Authorization": f"Bearer {TOKEN}"}
        self.assertEqual(self.server.ask("GET", "/api/database", headers=bearer)[0], 200)
        log_in = ("POST", "/api/session")
        self.refused(self.server.ask(*log_in, json.dumps({"token": "wrong-wrong-wrong"})), 401,
                     "not the token")
        self.refused(self.server.ask(*log_in, json.dumps({"token": TOKEN}),
                                     {"Origin": "http://evil.example"}), 403, "other sites")
        status, headers, _ = self.server.ask(*log_in, json.dumps({"token": TOKEN}))
        self.assertEqual(status, 204)
        cookie = headers["Set-Cookie"]
        self.assertRegex(cookie, "HttpOnly; SameSite=Strict")
        self.assertNotIn(TOKEN, cookie)
        kept = {"Cookie": "other=1; " + cookie.split(";")[0]}
        self.assertEqual(self.server.ask("GET", "/api/database", headers=kept)[0], 200)

    @classmethod
    def works(cls):
        pass


class Starting(cli.CliTest):
    def database(self):
        self.put("a.xyz", shapes.xyz(shapes.dumbbell(1500)))
        self.run_morsel("index", "--database", "s.db", "a.xyz")

    def test_wrong_usage_is_named(self):
        self.database()
        serve = ("serve", "--database", "s.db", "--port", "0")
        self.refuse(cli.USAGE, "token of 16", *serve, "--host", "0.0.0.0")
        self.refuse(cli.USAGE, "16 to 256", *serve, "--token", "short")
        self.refuse(cli.USAGE, "16 to 256", *serve, "--token", "with a space in between")
        self.refuse(cli.USAGE, "host is empty", *serve, "--host", "")
        self.refuse(cli.USAGE, "--port", "serve", "--database", "s.db", "--port", "65536")
        self.refuse(cli.INPUT, "missing.db", "serve", "--database", "missing.db")
        self.refuse(cli.INPUT, "cannot listen", *serve, "--host", "192.0.2.1", "--token", TOKEN)

    def test_one_server_a_port(self):
        self.database()
        server = Server(self.folder, "s.db")
        try:
            self.refuse(cli.INPUT, "another program", "serve", "--database", "s.db", "--port",
                        str(server.port))
        finally:
            self.assertEqual(server.stop()[0], cli.DONE)

    def test_it_stops_whatever_goes_on(self):
        self.database()
        for how in (signal.SIGINT, signal.SIGTERM):
            server = Server(self.folder, "s.db")
            _, _, body = server.send("long.xyz", shapes.xyz(shapes.dumbbell(60000)).encode())
            events = server.connect()
            events.sendall(f"GET /api/upload/events?id={json.loads(body)['id']} HTTP/1.1\r\n"
                           f"Host: {server.host}\r\n\r\n".encode())
            idle, slow = server.connect(), server.connect()
            slow.sendall(b"GET / HTTP")
            self.assertEqual(server.stop(how), (cli.DONE, ""))
            for connection in (events, idle, slow):
                connection.close()

    def test_an_empty_database_is_served(self):
        self.database()
        self.run_morsel("remove", "--database", "s.db", "a.xyz")
        server = Server(self.folder, "s.db")
        try:
            self.assertIn("(0 shapes)", server.greeting)
            self.assertEqual(server.get("/api/shapes"), {"total": 0, "shapes": []})
            self.assertEqual(server.get("/api/matrix"), {"shapes": [], "scores": []})
        finally:
            self.assertEqual(server.stop()[0], cli.DONE)


if __name__ == "__main__":
    cli.main(__doc__)
