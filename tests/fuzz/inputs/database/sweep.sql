UPDATE sweep SET design = 'grid', what = 'inverse', points = 10, keys = '["platform.mass"]', pointwise = NULL, shard = 1, shards = 2;
