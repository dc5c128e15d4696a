"""Exceptions of the package."""


class InputError(ValueError):
    """A mesh or a step that the detector refuses; `name` names the reason in one word.

    The names are those of detector/mesh/problem.h: "index_out_of_range", "wrong_frame_size",
    "non_finite_coordinate", "foreign_state", ...
    """

    def __init__(self, message: str, name: str):
        super().__init__(message)
        self.name = name

    def __reduce__(self):
        return InputError, (str(self), self.name)


class AssayError(RuntimeError):
    """The line with which the program `assay` gave up; `code` is its exit code."""

    def __init__(self, message: str, code: int):
        super().__init__(message)
        self.code = code

    def __reduce__(self):
        return AssayError, (str(self), self.code)
