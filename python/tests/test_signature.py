"""Signatures as values."""

import pickle

import numpy as np
import pytest

import morsel
import shapes


def test_a_value(shape):
    signature = shape.signature
    same = [morsel.Signature.from_bytes(signature.to_bytes()),
            morsel.Signature.from_json(signature.to_json()), pickle.loads(pickle.dumps(signature))]
    assert all(other == signature for other in same)
    assert len({signature, *same}) == 1
    assert signature != morsel.segment(shapes.torus(3000)).signature
    assert len(signature.to_bytes()) <= 1024


def test_what_it_holds(shape):
    signature = shape.signature
    weights = np.array([part.weight for part in signature.parts])
    volumes = np.array([part.volume for part in shape.parts])
    assert np.allclose(weights, volumes / volumes.sum(), atol=1e-3)
    for kept, part in zip(signature.parts, shape.parts):
        assert np.allclose(kept.center * signature.size + signature.centroid, part.center, atol=0.01)
        assert np.allclose(kept.covariance * signature.size**2, part.covariance, atol=0.01)
        assert [n.part for n in kept.neighbours] == [n.part for n in part.neighbours]
    assert signature.tables.dtype == np.uint8


def test_damage_is_told(shape):
    good = shape.signature.to_bytes()
    for bad in (b"", good[:-1], good[:50] + bytes([good[50] ^ 1]) + good[51:]):
        with pytest.raises(ValueError, match="^signature"):
            morsel.Signature.from_bytes(bad)
    with pytest.raises(ValueError, match="signature_version"):
        morsel.Signature.from_json("{}")
