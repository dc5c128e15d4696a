"""Converts arguments that are not yet arrays of the right kind.

A number that float64 or int32 cannot hold exactly is refused, because answers are those of exact
arithmetic on the numbers given.
"""

import numpy as np


def positions(given, name):
    """float64, n x 3. TypeError: no array of real numbers. ValueError: another shape; inexact."""
    return _rows(_real(given, name), given, name, np.float64)


def triangles(given, name):
    """int32, m x 3. TypeError: no array of integers. ValueError: another shape; beyond int32."""
    array = _array(given, name)
    if array.dtype.kind not in "iu" and array.size:
        raise TypeError(f"{name}: integers are wanted, not dtype {array.dtype}")
    return _rows(array, given, name, np.int32)


def queries(given, name):
    """float64, k x 4 x 3, contiguous, finite."""
    array = _real(given, name)
    if array.ndim != 3 or array.shape[1:] != (4, 3):
        raise ValueError(f"{name}: shape {array.shape} is not (k, 4, 3)")
    array = np.ascontiguousarray(_exactly(array, name, np.float64))
    if not np.isfinite(array).all():
        raise ValueError(f"{name}: a coordinate is not finite")
    return array


def _array(given, name):
    if isinstance(given, np.ma.MaskedArray):
        raise TypeError(f"{name}: a masked array is not taken: a masked coordinate has no value")
    try:
        return np.asarray(given)
    except ValueError as error:  # rows of different lengths
        raise ValueError(f"{name}: {error}") from None


def _real(given, name):
    array = _array(given, name)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name}: real numbers are wanted, not dtype {array.dtype}")
    return array


def _rows(array, given, name, dtype):
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: shape {array.shape} is not (n, 3)")
    return np.require(_exactly(array, name, dtype), requirements=["C", "A"])


def _exactly(array, name, dtype):
    if array.dtype == dtype:
        return array.astype(dtype, copy=False)
    with np.errstate(over="ignore", invalid="ignore"):
        converted = array.astype(dtype)
        # Python compares an integer and a float as floats: back and forth tells.
        back = converted.astype(array.dtype)
    same = (back == array) | (array != array)
    if not same.all():
        raise ValueError(f"{name}: a number of dtype {array.dtype} has no exact {np.dtype(dtype)}")
    return converted
