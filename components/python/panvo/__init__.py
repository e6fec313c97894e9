# SPDX-License-Identifier: Apache-2.0
"""Visual odometry with drift correction, on NumPy arrays.

Images are uint8, (height, width) grey or (height, width, 3) BGR. Poses are 4 x 4 arrays, a_from_b, in metres. Trajectories are arrays of
N x 8: stamp_s x y z qx qy qz qw. Unusable data raise panvo.Error, wrong arguments TypeError or ValueError. Computation releases the GIL.
"""
from ._core import (
    Bag,
    BagError,
    CalibrationError,
    Compass,
    DecodeError,
    Error,
    EvaluationError,
    Message,
    OdometryEstimate,
    PanoramaFrame,
    Place,
    PlaceMatch,
    Places,
    Recording,
    RecordingError,
    StereoCalibration,
    StereoFrame,
    StereoOdometry,
    Topic,
    Turn,
    __version__,
    evaluate,
    read_trajectory,
)

__all__ = [
    "Bag", "BagError", "CalibrationError", "Compass", "DecodeError", "Error", "EvaluationError", "Message", "OdometryEstimate", "PanoramaFrame",
    "Place", "PlaceMatch", "Places", "Recording", "RecordingError", "StereoCalibration", "StereoFrame", "StereoOdometry", "Topic", "Turn",
    "__version__", "evaluate", "read_trajectory",
]

# Error messages and documentation show the public names.
for _name in __all__:
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = __name__
del _name
