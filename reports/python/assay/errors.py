"""Exceptions of the package."""


class InputError(ValueError):
    """A mesh or a step that the detector does not take; `name` says why in a word.

    The names are those of detector/mesh/problem.h: "index_out_of_range", "wrong_frame_size",
    "non_finite_coordinate", "foreign_state", ...
    """

    def __init__(self, message: str, name: str):
        super().__init__(message)
        self.name = name

    def __reduce__(self):
        return InputError, (str(self), self.name)


class AssayError(RuntimeError):
    """What the program `assay` could not do, in its own line; `code` is its exit code."""

    def __init__(self, message: str, code: int):
        super().__init__(message)
        self.code = code

    def __reduce__(self):
        return AssayError, (str(self), self.code)
