"""Long work: progress, Ctrl-C, other threads."""

import os
import signal
import threading
import time

import numpy as np
import pytest

import morsel
import shapes

STAGES = ["sort", "ground", "denoise", "triangulate", "neighbors", "interior", "basins", "merge",
          "cut", "done"]


@pytest.fixture(scope="module")
def large():
    return shapes.dumbbell(60_000)


@pytest.fixture
def obeys_ctrl_c():
    """Programs that a script starts in the background ignore SIGINT otherwise."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_progress(points):
    heard = []
    morsel.segment(points, progress=lambda *report: heard.append((*report, threading.get_ident())))
    assert [stage for stage, _, _ in heard] == STAGES
    fractions = [fraction for _, fraction, _ in heard]
    assert fractions == sorted(fractions) and fractions[-1] == 1
    assert {thread for _, _, thread in heard} == {threading.get_ident()}


def test_a_callback_that_raises_cancels(large):
    heard = []

    def stop(stage, fraction):
        heard.append(stage)
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        morsel.segment(large, progress=stop)
    assert heard == ["sort"]
    with pytest.raises(TypeError):
        morsel.segment(large, progress=3)


@pytest.mark.usefixtures("obeys_ctrl_c")
def test_ctrl_c_cancels(large, points, shape):
    heard = []
    interrupt = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    interrupt.start()  # while morsel works: other threads go on
    with pytest.raises(KeyboardInterrupt):
        for _ in range(100):  # however fast the machine
            morsel.segment(large, progress=lambda stage, _: heard.append(stage))
    interrupt.join()
    assert "ground" in heard
    assert np.array_equal(morsel.segment(points).labels, shape.labels)


@pytest.mark.usefixtures("obeys_ctrl_c")
def test_ctrl_c_leaves_what_is_stored():
    names = [f"{number}.npy" for number in range(30)]
    for number, name in enumerate(names):
        np.save(name, shapes.dumbbell(2000, seed=number))

    def interrupt(stage, share):
        if share > 0.2:
            os.kill(os.getpid(), signal.SIGINT)

    with morsel.Database("shapes.db") as database:
        with pytest.raises(KeyboardInterrupt):
            database.add_files(names, progress=interrupt)
        stored = len(database)
        assert 6 < stored < 30
        assert database.add_files(names).added == 30 - stored


def test_other_threads_go_on(large):
    ticks = []
    done = threading.Event()

    def tick():
        while not done.wait(0.001):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    morsel.segment(large, threads=1)
    done.set()
    thread.join()
    assert len(ticks) > 20


def test_several_at_once(points, shape):
    labels = [None] * 4

    def work(number):
        labels[number] = morsel.segment(points).labels

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(one, shape.labels) for one in labels)
