"""Objects of points by their detector and by scikit-learn's DBSCAN: prints a table of streets with as many objects as vehicles."""
import sys
from collections import Counter
try:
    import numpy as np
    import sklearn
    from sklearn.cluster import DBSCAN
except ImportError:
    sys.exit(print("skipped: scikit-learn is not here"))
file, *numbers = sys.argv[1:]
range_m, velocity_mps, cross_m, span_mps = map(float, numbers)
table = np.loadtxt(file, delimiter=",")
streets = [table[table[:, 0] == street] for street in np.unique(table[:, 0])]


def by_dbscan(points, least):
    def apart(column, reach, around=None):
        difference = np.abs(points[:, None, column] - points[None, :, column])
        return (difference if around is None else np.minimum(difference, around - difference)) / reach
    # The largest of the three in reaches: near in all of them, as in the crate.
    distance = np.maximum.reduce([apart(2, range_m), apart(3, velocity_mps, span_mps), apart(4, cross_m)])
    return DBSCAN(eps=1.0, min_samples=least, metric="precomputed").fit_predict(distance)


def row(name, labels_of):
    few = right = many = lost = cut = vehicles = 0
    for points in streets:
        labels = labels_of(points)
        objects = [points[labels == label] for label in sorted(set(labels) - {-1})]
        count = int(points[0, 1])
        few, right, many = few + (len(objects) < count), right + (len(objects) == count), many + (len(objects) > count)
        owners = Counter(Counter(o[:, 7]).most_common(1)[0][0] for o in objects)
        vehicles += count
        lost += sum(owners[v] == 0 for v in range(count))
        cut += sum(owners[v] > 1 for v in range(count))
    print(f"| {name} | {few} | {right} | {many} | {lost} | {cut} |")


vehicles = sum(int(points[0, 1]) for points in streets)
print(f"{len(streets)} streets, {vehicles} vehicles, {len(table)} points; scikit-learn {sklearn.__version__}\n")
print("| | too few objects | as many as vehicles | too many | vehicles lost | vehicles cut |\n|---|---|---|---|---|---|")
row("this crate", lambda points: points[:, 6].astype(int))
for least in (1, 2, 3, 5):
    row(f"DBSCAN, {least} point{'s' * (least > 1)}", lambda points: by_dbscan(points, least))
