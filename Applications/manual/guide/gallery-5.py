"""Trabecular bone: local thickness. Prints:

BV/TV 0.28
Tb.Th 0.268 mm, sd 0.079
Tb.Sp 0.419 mm, sd 0.111
"""

import matplotlib.pyplot as plt
import numpy
import voxelcore

random = numpy.random.default_rng(1).normal(size=(56, 56, 56))
waves = numpy.sqrt(sum(numpy.square(numpy.meshgrid(*[numpy.fft.fftfreq(56)] * 3))))
noise = numpy.fft.ifftn(numpy.fft.fftn(random) * numpy.exp(-(((waves - 0.055) / 0.012) ** 2))).real
bone = noise > 0.6 * noise.std()

spacing = (0.035, 0.035, 0.035)  # mm
trabeculae = voxelcore.thickness(bone, spacing=spacing)
marrow = voxelcore.thickness(~bone, spacing=spacing)
print(f"BV/TV {bone.mean():.2f}")
for name, found in ("Tb.Th", trabeculae), ("Tb.Sp", marrow):
    print(f"{name} {found.map[found.map > 0].mean():.3f} mm, sd {found.map[found.map > 0].std():.3f}")

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
shown = left.imshow(numpy.ma.masked_equal(trabeculae.map[:, :, 28].T, 0), origin="lower", extent=(0, 1.96, 0, 1.96))
figure.colorbar(shown, ax=left, label="thickness, mm")
left.set(xlabel="mm", ylabel="mm")
for name, found in ("Tb.Th", trabeculae), ("Tb.Sp", marrow):
    right.hist(found.map[found.map > 0], bins=40, alpha=0.6, density=True, label=name)
right.set(xlabel="mm", yticks=[])
right.legend()
figure.savefig("gallery-5.png", dpi=80)
