"""Converts arguments that are not yet arrays of the right kind.

A number without exact float64 or int32 is refused, because answers are exact for given numbers.
"""

import numpy as np


def positions(given, name):
    """Returns float64 (n, 3). TypeError: no real numbers. ValueError: another shape; not exact."""
    return _rows(_real(given, name), given, name, np.float64)


def triangles(given, name):
    """Returns int32 (m, 3). TypeError: no integers. ValueError: another shape, or beyond int32."""
    array = _array(given, name)
    if array.dtype.kind not in "iu" and array.size:
        raise TypeError(f"{name}: integers are wanted, not dtype {array.dtype}")
    return _rows(array, given, name, np.int32)


def queries(given, name):
    """Returns float64 (k, 4, 3), contiguous and finite. Errors are those of positions()."""
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
