"""Databases of shapes."""

import threading

import numpy as np
import pytest

import morsel
import shapes

TOYS = {"dumbbell": shapes.dumbbell, "ring": shapes.torus, "snowman": shapes.snowman}


@pytest.fixture(scope="module")
def toys():
    return {name: morsel.segment(make(3000)) for name, make in TOYS.items()}


@pytest.fixture
def database(toys):
    with morsel.Database("toys.db") as opened:
        for name, toy in toys.items():
            assert opened.add(name, toy, class_name="toy", tags=["b", "a"]) == "added"
        yield opened


def test_list_and_names(database):
    assert len(database) == 3 and "ring" in database and "none" not in database
    assert [info.name for info in database.list()] == sorted(TOYS)
    assert database.list(class_name="chair") == [] == database.list(tag="c")
    assert database.list(tag="a")[0] == morsel.ShapeInfo("dumbbell", "toy", ["a", "b"], "")


def test_adding_again(database, toys):
    assert database.add("ring", toys["ring"]) == "unchanged"
    assert database.list()[1].class_name == "toy"
    assert database.add("ring", toys["ring"].points) == "unchanged"
    assert database.add("ring", toys["ring"], class_name="") == "replaced"
    assert database.add("ring", toys["snowman"], source="scan.ply") == "replaced"
    assert database.list()[1] == morsel.ShapeInfo("ring", "", ["a", "b"], "scan.ply")


def test_another_cut_is_another_content(database, toys):
    assert database.add("ring", toys["ring"].cut(parts=1)) == "replaced"
    assert database.signature("ring") == toys["ring"].cut(parts=1).signature


def test_search(database, toys):
    query = morsel.segment(0.3 * shapes.torus(3000, seed=9)[:, [2, 0, 1]])
    hits = database.search(query, top=2)
    assert len(hits) == 2 and hits[0].name == "ring"
    assert hits[0].score == morsel.match(toys["ring"], query).score
    assert hits == database.search(query.signature, top=2)
    assert len(database.search(query.points)) == 3
    assert database.search(query, method="paper")[0].score <= 1
    assert database.search(query, mode="articulated")[0].name == "ring"
    half = query.points[query.points[:, 0] < 0.05]
    assert database.search(half, mode="partial")[0].name == "ring"
    with pytest.raises(ValueError, match="only the mode 'partial'"):
        database.search(query, same_scale=True)
    with pytest.raises(ValueError, match="top is 0"):
        database.search(query, top=0)


def test_matrix_is_all_matches(database, toys):
    infos, scores = database.matrix()
    assert [info.name for info in infos] == sorted(TOYS)
    expected = [[morsel.match(toys[a.name], toys[b.name]).score for b in infos] for a in infos]
    assert np.array_equal(scores, expected)
    assert np.array_equal(scores, scores.T) and np.all(np.diag(scores) == 1)


def test_remove_and_rename(database):
    database.rename("ring", "torus")
    with pytest.raises(KeyError, match="ring"):
        database.rename("ring", "x")
    with pytest.raises(ValueError, match="named 'torus' already"):
        database.rename("snowman", "torus")
    with pytest.raises(KeyError, match="none"):
        database.remove("torus", "none")
    assert "torus" in database
    database.remove("torus", "snowman")
    assert len(database) == 1
    with pytest.raises(KeyError):
        database.signature("torus")


def test_files(points):
    np.save("a.npy", points)
    np.save("b.npy", shapes.torus(2000))
    with open("bad.xyz", "w", encoding="ascii") as file:
        file.write("nothing\n")
    heard = []
    with morsel.Database("files.db") as database:
        report = database.add_files(["./a.npy", "b.npy", "bad.xyz", "none.xyz"], class_name="c",
                                    progress=lambda *report: heard.append(report))
        assert (report.added, report.replaced, report.unchanged) == (2, 0, 0)
        assert [path for path, _ in report.failures] == ["bad.xyz", "none.xyz"]
        assert sorted(heard) == [("index", number / 4) for number in (1, 2, 3, 4)]
        assert database.add_files(["a.npy", "b.npy"]).unchanged == 2
        assert database.list()[0] == morsel.ShapeInfo("a.npy", "c", [], "a.npy")
        assert database.add("a.npy", points) == "unchanged"


def test_open():
    with pytest.raises(FileNotFoundError):
        morsel.Database("none.db", mode="r")
    with pytest.raises(FileNotFoundError):
        morsel.Database("none/shapes.db")
    with pytest.raises(ValueError, match="mode is 'x'"):
        morsel.Database("shapes.db", mode="x")
    with pytest.raises(ValueError, match="give the path of a file, or postgresql://"):
        morsel.Database("http://localhost:8000")
    with pytest.raises(OSError, match="postgresql://me@localhost:1/shapes: cannot connect"):
        morsel.Database("postgresql://me:secret@localhost:1/shapes")
    with open("text.db", "w", encoding="ascii") as file:
        file.write("text, and more than an SQLite header has bytes. " * 10)
    with pytest.raises(morsel.Error, match="text.db: is not a database of morsel"):
        morsel.Database("text.db")


def test_read_only(database, toys):
    with morsel.Database("toys.db", mode="r") as reader:
        assert len(reader) == 3
        with pytest.raises(OSError):
            reader.add("more", toys["ring"])


def test_what_cannot_be_stored(database):
    with pytest.raises(ValueError, match="on one plane"):
        database.add("flat", np.random.default_rng(1).random((500, 3)) * [1, 1, 0])
    with pytest.raises(ValueError, match="name"):
        database.add("", shapes.torus(2000))


def test_closed(database):
    database.close()
    database.close()
    for use in (len, morsel.Database.list, morsel.Database.matrix):
        with pytest.raises(ValueError, match="closed"):
            use(database)


def test_threads(database, toys):
    failures = []

    def work(number):
        try:
            database.add(f"copy {number}", toys["ring"])
            assert database.search(toys["ring"], top=1)[0].score == 1
        except Exception as failure:
            failures.append(failure)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == [] and len(database) == 11
