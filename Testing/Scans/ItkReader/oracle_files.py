"""Small scans of foreign formats, written by the programs that define them (pydicom, mrcfile, h5py, MINC's and VTK's
own tools) or byte by byte, with what must be read of them. Used by compare_with_oracles.py."""
import struct

import numpy

# One voxel of label 9 among blocks of others: k, j, i.
VOLUME = numpy.zeros((5, 6, 7), numpy.uint8)
VOLUME[0:2, 1:4, 2:5] = 1
VOLUME[3, 0:6, 0:3] = 2
VOLUME[4, 5, 6] = 3
VOLUME[1, 4, 5] = 9
SPACING = (0.5, 0.75, 1.25)  # i, j, k in mm


def turns():
    """The 48 ways in which i, j and k can run along the axes of space: rows are the directions of i, j, k."""
    for a in range(3):
        for b in range(3):
            if a == b:
                continue
            c = 3 - a - b
            for signs in range(8):
                axes = numpy.zeros((3, 3))
                for row, axis in enumerate((a, b, c)):
                    axes[row, axis] = -1 if signs >> row & 1 else 1
                yield axes


def affine(axes, spacing, origin):
    """3 x 4: index to LPS mm."""
    return numpy.column_stack([numpy.asarray(axes).T * numpy.asarray(spacing), origin])


def dicom_set(sop_class, series, number=1):
    import pydicom
    from pydicom.dataset import FileMetaDataset

    ds = pydicom.Dataset()
    ds.file_meta = FileMetaDataset()
    ds.file_meta.TransferSyntaxUID = pydicom.uid.ExplicitVRLittleEndian
    ds.file_meta.MediaStorageSOPClassUID = ds.SOPClassUID = sop_class
    ds.file_meta.MediaStorageSOPInstanceUID = ds.SOPInstanceUID = f"{series}.{number}"
    ds.is_little_endian, ds.is_implicit_VR = True, False
    ds.StudyInstanceUID, ds.SeriesInstanceUID, ds.FrameOfReferenceUID = "1.2.3", series, "1.2.4"
    ds.InstanceNumber = number
    ds.PatientName, ds.PatientID = "None", "none"
    return ds


def set_pixels(ds, pixels, bits=None):
    ds.SamplesPerPixel, ds.PhotometricInterpretation = 1, "MONOCHROME2"
    ds.Rows, ds.Columns = pixels.shape[-2:]
    ds.BitsAllocated = 8 * pixels.dtype.itemsize
    ds.BitsStored = bits or ds.BitsAllocated
    ds.HighBit = ds.BitsStored - 1
    ds.PixelRepresentation = 1 if pixels.dtype.kind == "i" else 0
    ds.PixelData = pixels.tobytes() + b"\0" * (pixels.nbytes % 2)


CT = "1.2.840.10008.5.1.4.1.1.2"
ENHANCED_CT = "1.2.840.10008.5.1.4.1.1.2.1"
SEGMENTATION = "1.2.840.10008.5.1.4.1.1.66.4"
LABEL_MAP = "1.2.840.10008.5.1.4.1.1.66.7"


def series(folder, volume, axes, origin, spacing=SPACING, uid="1.2.5", change=None, order=None, dtype="u2", name="IM"):
    """A CT series in `folder`, one file a slice; `change(ds, k)` may alter each before it is written."""
    folder.mkdir(parents=True, exist_ok=True)
    for k, pixels in enumerate(volume):
        number = (order or range(len(volume)))[k] + 1
        ds = dicom_set(CT, uid, number)
        ds.Modality = "CT"
        ds.ImagePositionPatient = [f"{x:.6f}" for x in numpy.asarray(origin) + k * spacing[2] * axes[2]]
        ds.ImageOrientationPatient = [*axes[0], *axes[1]]
        ds.PixelSpacing = [spacing[1], spacing[0]]
        ds.SliceThickness = spacing[2]
        set_pixels(ds, pixels.astype(dtype))
        if change:
            change(ds, k)
        ds.save_as(folder / f"{name}{number:04d}", write_like_original=False)
    return folder


def frame_groups(position, segment=None, orientation=None):
    import pydicom

    item = pydicom.Dataset()
    item.PlanePositionSequence = [pydicom.Dataset()]
    item.PlanePositionSequence[0].ImagePositionPatient = [f"{x:.6f}" for x in position]
    if orientation is not None:
        item.PlaneOrientationSequence = [pydicom.Dataset()]
        item.PlaneOrientationSequence[0].ImageOrientationPatient = list(orientation)
    if segment is not None:
        item.SegmentIdentificationSequence = [pydicom.Dataset()]
        item.SegmentIdentificationSequence[0].ReferencedSegmentNumber = segment
    return item


def shared_groups(axes, spacing, between=True):
    import pydicom

    item = pydicom.Dataset()
    item.PixelMeasuresSequence = [pydicom.Dataset()]
    measures = item.PixelMeasuresSequence[0]
    measures.PixelSpacing = [spacing[1], spacing[0]]
    measures.SliceThickness = spacing[2]
    if between:
        measures.SpacingBetweenSlices = spacing[2]
    item.PlaneOrientationSequence = [pydicom.Dataset()]
    item.PlaneOrientationSequence[0].ImageOrientationPatient = [*axes[0], *axes[1]]
    return item


def segmentation(path, frames, segments, axes, origin, spacing=SPACING, kind="BINARY", between=True, change=None):
    """frames: (k, segment number, plane of 0 and 1, of fractions, or of labels); segments: (number, label, CIELab)."""
    import pydicom

    ds = dicom_set(LABEL_MAP if kind == "LABELMAP" else SEGMENTATION, "1.2.6")
    ds.Modality = "SEG"
    planes = numpy.stack([plane for _, _, plane in frames])
    set_pixels(ds, planes)
    ds.NumberOfFrames = len(frames)
    ds.SegmentationType = kind
    if kind == "BINARY":
        ds.BitsAllocated, ds.BitsStored, ds.HighBit = 1, 1, 0
        bits = numpy.packbits(planes.ravel() != 0, bitorder="little").tobytes()
        ds.PixelData = bits + b"\0" * (len(bits) % 2)
    if kind == "FRACTIONAL":
        ds.SegmentationFractionalType, ds.MaximumFractionalValue = "PROBABILITY", 200
    ds.SegmentSequence = []
    for number, label, lab in segments:
        item = pydicom.Dataset()
        item.SegmentNumber, item.SegmentLabel, item.SegmentAlgorithmType = number, label, "MANUAL"
        if lab:
            item.RecommendedDisplayCIELabValue = lab
        ds.SegmentSequence.append(item)
    ds.SharedFunctionalGroupsSequence = [shared_groups(axes, spacing, between)]
    ds.PerFrameFunctionalGroupsSequence = [
        frame_groups(numpy.asarray(origin) + k * spacing[2] * axes[2], None if kind == "LABELMAP" else segment)
        for k, segment, _ in frames
    ]
    if change:
        change(ds)
    ds.save_as(path, write_like_original=False)
    return path


def enhanced(path, volume, axes, origin, change=None):
    ds = dicom_set(ENHANCED_CT, "1.2.7")
    set_pixels(ds, volume.astype("u2"))
    ds.NumberOfFrames = len(volume)
    ds.SharedFunctionalGroupsSequence = [shared_groups(axes, SPACING)]
    ds.PerFrameFunctionalGroupsSequence = [
        frame_groups(numpy.asarray(origin) + k * SPACING[2] * axes[2]) for k in range(len(volume))
    ]
    if change:
        change(ds)
    ds.save_as(path, write_like_original=False)
    return path


def itk_hdf5(path, volume, axes, origin):
    import h5py

    with h5py.File(path, "w") as file:
        group = file.create_group("ITKImage/0")
        file["ITKVersion"], file["HDFVersion"] = "5.2.1", "1.10"
        group["Dimension"] = numpy.array(volume.shape[::-1], "u8")
        group["Directions"] = numpy.asarray(axes, float)
        group["Origin"], group["Spacing"] = numpy.asarray(origin, float), numpy.asarray(SPACING, float)
        group.create_dataset("VoxelData", data=volume)
        group["VoxelType"] = {"u1": "UCHAR", "u2": "USHORT", "i2": "SHORT", "u4": "UINT"}[volume.dtype.str[1:]]
        group.create_group("MetaData")
    return path


def gipl(path, volume, kind, dtype, matrix=None, offset=0.0, scale=0.0, cut=0):
    header = struct.pack(
        ">5H4f80s20f2B2d4d4fI", *volume.shape[::-1], 1, kind, *SPACING, 1, b"", *(matrix or [0.0] * 20), 0, 0, 0, 0,
        1, 2, 3, 0, offset, scale, 0, 0, 719555000)
    data = header + volume.astype(dtype).tobytes()
    path.write_bytes(data[: len(data) - cut])
    return path
